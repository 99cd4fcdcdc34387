#include "experiments/python/arrays.h"

#include <fmt/format.h>

#include <cstring>

#include "core/base/error.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

// Describes what was given instead of an array: "(270, 480) of float64", "a list".
std::string described(const py::handle& object) {
  if (!py::isinstance<py::array>(object))
    return fmt::format("is of type {}",
                       py::str(py::type::handle_of(object).attr("__name__")).cast<std::string>());
  const auto array = py::reinterpret_borrow<py::array>(object);
  return fmt::format("is {} of {}", py::str(array.attr("shape")).cast<std::string>(),
                     py::str(array.dtype()).cast<std::string>());
}

}  // namespace

py::array arrayOf(std::shared_ptr<const Image> image) {
  const auto* holder = new std::shared_ptr<const Image>(std::move(image));
  const py::capsule base(
      holder, [](void* held) { delete static_cast<const std::shared_ptr<const Image>*>(held); });
  const Image& shown = **holder;
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  py::array_t<float> array({py::ssize_t(shown.height), py::ssize_t(shown.width), py::ssize_t{3}},
                           reinterpret_cast<const float*>(shown.pixels.data()), base);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array arrayOf(Image image) { return arrayOf(std::make_shared<const Image>(std::move(image))); }

Image imageOf(const py::handle& object, const std::string& name) {
  const bool isArray = py::isinstance<py::array>(object);
  const auto given =
      isArray ? py::reinterpret_borrow<py::array>(object) : py::array(py::dtype::of<float>(), 0);
  if (!isArray || given.dtype().kind() != 'f' || given.ndim() != 3 || given.shape(2) != 3) {
    failUsage(fmt::format("{}: {}; must be an array (height, width, 3) of float32", name,
                          described(object)));
  }
  for (const int side : {0, 1}) {
    if (given.shape(side) < 1 || given.shape(side) > py::ssize_t(kMaxSide)) {
      failUsage(fmt::format("{}: {}; height and width must be 1 to {}", name, described(object),
                            kMaxSide));
    }
  }
  // Copies what is not float32 in this order.
  const py::array_t<float, py::array::c_style | py::array::forcecast> floats(given);
  Image image(uint32_t(floats.shape(1)), uint32_t(floats.shape(0)));
  std::memcpy(image.pixels.data(), floats.data(), size_t(floats.nbytes()));
  return image;
}

PixelMask maskOf(const py::handle& object, const std::string& name, const Image& image) {
  if (object.is_none()) return {};
  const bool isArray = py::isinstance<py::array>(object);
  const auto given =
      isArray ? py::reinterpret_borrow<py::array>(object) : py::array(py::dtype::of<float>(), 0);
  if (!isArray || given.dtype().kind() != 'b' || given.ndim() != 2 ||
      given.shape(0) != py::ssize_t(image.height) || given.shape(1) != py::ssize_t(image.width)) {
    failUsage(fmt::format("{}: {}; must be an array ({}, {}) of bool, True where a pixel counts",
                          name, described(object), image.height, image.width));
  }
  const py::array_t<bool, py::array::c_style> flags(given);
  return PixelMask(flags.data(), flags.data() + flags.size());
}

}  // namespace restlab::python
