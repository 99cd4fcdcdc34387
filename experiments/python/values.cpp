#include "experiments/python/values.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace restlab::python {

namespace py = pybind11;

using Json = nlohmann::ordered_json;

namespace {

std::string typeOf(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

// Returns Python's own value of what is a number: scalars of numpy, and whatever else has
// __index__ or __float__. Anything else is returned as it is.
py::object plain(const py::handle& object) {
  if (py::isinstance<py::bool_>(object) || py::isinstance<py::str>(object))
    return py::reinterpret_borrow<py::object>(object);
  const bool isScalar = py::hasattr(object, "item") && py::hasattr(object, "dtype") &&
                        py::hasattr(object, "shape") && py::len(object.attr("shape")) == 0;
  if (isScalar) {
    const py::object item = object.attr("item")();
    if (!item.is(object) && !py::isinstance(item, py::type::handle_of(object))) return item;
  }
  PyObject* number = nullptr;
  if (PyIndex_Check(object.ptr())) {
    number = PyNumber_Index(object.ptr());
  } else if (py::hasattr(object, "__float__")) {
    number = PyNumber_Float(object.ptr());
  } else {
    return py::reinterpret_borrow<py::object>(object);
  }
  if (number != nullptr) return py::reinterpret_steal<py::object>(number);
  if (!PyErr_ExceptionMatches(PyExc_TypeError) && !PyErr_ExceptionMatches(PyExc_ValueError))
    throw py::error_already_set();
  PyErr_Clear();  // an array of several numbers
  return py::reinterpret_borrow<py::object>(object);
}

}  // namespace

py::str strOf(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "replace"));
}

py::list listOf(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(strOf(text));
  return list;
}

py::dict dictOf(const std::map<std::string, std::string>& words) {
  py::dict dict;
  for (const auto& [key, word] : words) dict[strOf(key)] = strOf(word);
  return dict;
}

py::object objectOf(const Json& json) {
  switch (json.type()) {
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[strOf(key)] = objectOf(value);
      return dict;
    }
    case Json::value_t::array: {
      py::list list;
      for (const Json& value : json) list.append(objectOf(value));
      return list;
    }
    case Json::value_t::string:
      return strOf(json.get_ref<const std::string&>());
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_unsigned:
      return py::int_(json.get<uint64_t>());
    case Json::value_t::number_integer:
      return py::int_(json.get<int64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

py::object objectOf(const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return py::bool_(*flag);
  if (const int64_t* whole = std::get_if<int64_t>(&value)) return py::int_(*whole);
  if (const double* number = std::get_if<double>(&value)) return py::float_(*number);
  return strOf(std::get<std::string>(value));
}

ParameterValue valueOf(const py::handle& object, const std::string& name) {
  const py::object value = plain(object);
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::float_>(value)) return value.cast<double>();
  if (py::isinstance<py::int_>(value)) {
    int overflow = 0;
    const long long whole = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
    if (overflow != 0)
      failUsage(fmt::format("{}: a whole number of more than 64 bits is out of every range", name));
    return int64_t(whole);
  }
  failUsage(fmt::format("{}: is of type {}; must be a number, True or False, or a text", name,
                        typeOf(object)));
}

std::string nameOrIndexOf(const py::handle& object, const std::string& name) {
  const py::object value = plain(object);
  const bool isIndex = py::isinstance<py::int_>(value) && !py::isinstance<py::bool_>(value);
  return isIndex ? std::string(py::str(value)) : textOf(object, name);
}

std::string textOf(const py::handle& object, const std::string& name) {
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::hasattr(object, "__fspath__")) {
    return py::module_::import("os").attr("fsencode")(object).cast<std::string>();
  }
  failUsage(fmt::format("{}: is of type {}; must be a text or a path", name, typeOf(object)));
}

}  // namespace restlab::python
