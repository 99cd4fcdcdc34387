#include "core/scene/gltf/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/gltf/json.h"
#include "core/scene/gltf/schema.h"

namespace restlab::gltf {
namespace {

using nlohmann::json;

// Place of the walk in the document; formatted only for messages.
class Place {
 public:
  void push(const std::string& name) { segments_.push_back({name, 0, false}); }
  void push(size_t index) { segments_.push_back({"", index, true}); }
  void pop() { segments_.pop_back(); }
  std::string str() const {
    std::string text;
    for (const Segment& segment : segments_) {
      if (segment.isIndex) {
        text += fmt::format("[{}]", segment.index);
      } else {
        text += (text.empty() ? "" : ".") + segment.name;
      }
    }
    return text;
  }

 private:
  struct Segment {
    std::string name;
    size_t index;
    bool isIndex;
  };
  std::vector<Segment> segments_;
};

template <class T>
std::string listOf(const std::vector<T>& values) {
  return fmt::format("{}", fmt::join(values, ", "));
}

// Formats a number; 1e308 stands for all larger ones (boundNumbers() in
// core/scene/gltf/container.cpp).
std::string textOf(double number) {
  return std::abs(number) < 1e308 ? fmt::format("{:g}", number) : "a number of 1e308 or more";
}

class Walker {
 public:
  Walker(json& document, Report& report) : document_(document), report_(report) {}

  void walkDocument() { walkObject(document_, documentSchema()); }

 private:
  // Fault in a dispensable field.
  struct Useless {
    std::string place, text;
  };

  [[noreturn]] void fail(const std::string& text) const {
    if (isDispensable_) throw Useless{place_.str(), text};
    report_.fail(place_.str(), text);
  }

  [[noreturn]] void failType(const json& value, const std::string& expected) const {
    fail(fmt::format("is {}; {} expected", typeName(value), expected));
  }

  void walkObject(json& value, const Schema& schema) {
    if (!value.is_object()) failType(value, "an object");
    for (const Field& field : schema.fields) walkMember(value, field);
    if (const auto it = value.find("extensions"); it != value.end() && it->is_null())
      leaveOutNull(value, "extensions");
    for (auto& [key, item] : value.items()) {
      if (key == "extensions") {
        place_.push(key);
        walkExtensions(item, schema);
        place_.pop();
      } else if (key != "extras") {
        warnUnknown(key, schema);
      }
    }
  }

  void walkMember(json& object, const Field& field) {
    const bool isDispensable = isDispensableIn(object, field);
    const auto it = object.find(field.name);
    if (it == object.end()) {
      if (!field.required) return;
      const std::string missing = fmt::format("'{}' is missing", field.name);
      if (!isDispensable) fail(missing);
      leaveOut(object, field, place_.str(), missing);
      return;
    }
    if (it->is_null() && !field.required) {
      leaveOutNull(object, field.name);
      return;
    }
    if (!isDispensable || isDispensable_) {  // faults go to the outer field
      place_.push(field.name);
      walkField(*it, field);
      place_.pop();
      return;
    }
    const Place here = place_;
    place_.push(field.name);
    isDispensable_ = true;
    try {
      walkField(*it, field);
      place_.pop();
    } catch (const Useless& useless) {
      place_ = here;
      leaveOut(object, field, useless.place, useless.text);
    }
    isDispensable_ = false;
  }

  static bool isDispensableIn(const json& object, const Field& field) {
    if (field.isDispensable) return true;
    if (field.unreadBeside) {
      const auto other = object.find(field.unreadBeside);
      if (other != object.end() && !other->is_null()) return true;
    }
    if (!field.enabledIf.name) return false;
    const auto says = object.find(field.enabledIf.name);
    return says == object.end() || *says != field.enabledIf.word;
  }

  void leaveOutNull(json& object, const char* key) {
    place_.push(key);
    report_.warn(fmt::format("null {}", key), place_.str(),
                 "is null; it is read as if it were not there");
    place_.pop();
    object.erase(key);
  }

  void leaveOut(json& object, const Field& field, const std::string& place,
                const std::string& text) {
    report_.warn(fmt::format("useless {}", field.name), place,
                 text + "; nothing that is drawn depends on it");
    object.erase(field.name);
    if (field.required) object[field.name] = 0.0;  // tinygltf requires it
  }

  void warnUnknown(const std::string& key, const Schema& schema) {
    std::vector<std::string> names;
    for (const Field& field : schema.fields) {
      if (key == field.name) return;
      names.push_back(field.name);
    }
    place_.push(key);
    report_.warn("unknown property", place_.str(),
                 fmt::format("unknown property, not read{}", didYouMean(key, names)));
    place_.pop();
  }

  // Walks the extension objects; extensions that are not read may be of any type.
  void walkExtensions(json& value, const Schema& schema) {
    if (!value.is_object()) failType(value, "an object");
    const auto& supported = supportedExtensions();
    std::vector<std::string> names;
    for (const auto& [name, item] : value.items()) names.push_back(name);
    for (const std::string& name : names) {
      if (value[name].is_null()) {
        leaveOutNull(value, name.c_str());
        continue;
      }
      const auto known =
          std::find_if(schema.extensions.begin(), schema.extensions.end(),
                       [&](const auto& extension) { return name == extension.first; });
      place_.push(name);
      if (known != schema.extensions.end()) {
        walkObject(value[name], *known->second);
      } else {
        if (std::find(supported.begin(), supported.end(), name) != supported.end())
          report_.warn("misplaced extension", place_.str(), "this extension has no meaning here");
        if (!value[name].is_object()) value.erase(name);
      }
      place_.pop();
    }
  }

  void walkField(json& value, const Field& field) {
    switch (field.kind) {
      case Kind::integer:
        walkInteger(value, field);
        break;
      case Kind::number:
        walkNumber(value, field);
        break;
      case Kind::boolean:
        if (!value.is_boolean()) failType(value, "true or false");
        break;
      case Kind::text:
        walkText(value, field);
        break;
      case Kind::numbers:
        if (!value.is_array()) failType(value, "an array of numbers");
        if (field.count != 0 && value.size() != field.count) {
          fail(fmt::format("has {} elements; {} expected", value.size(), field.count));
        }
        forEach(value, [&](json& item) { walkNumber(item, field); });
        break;
      case Kind::texts:
        if (!value.is_array()) failType(value, "an array of strings");
        forEach(value, [&](json& item) { walkText(item, field); });
        break;
      case Kind::object:
        walkObject(value, *field.schema);
        break;
      case Kind::objects:
        if (!value.is_array()) failType(value, "an array of objects");
        if (value.empty()) warnEmpty();
        forEach(value, [&](json& item) { walkObject(item, *field.schema); });
        break;
      case Kind::reference:
        walkReference(value, field);
        break;
      case Kind::references:
        if (!value.is_array()) failType(value, "an array of indices");
        if (value.empty()) warnEmpty();
        forEach(value, [&](json& item) { walkReference(item, field); });
        break;
      case Kind::referenceMap:
      case Kind::integerMap:
        if (!value.is_object()) failType(value, "an object");
        for (auto& [key, item] : value.items()) {
          place_.push(key);
          field.kind == Kind::referenceMap ? walkReference(item, field) : walkInteger(item, field);
          place_.pop();
        }
        break;
      case Kind::ignored:
        if (value.is_array() && value.empty()) warnEmpty();
        break;
    }
  }

  template <class Visit>
  void forEach(json& array, Visit visit) {
    for (size_t i = 0; i < array.size(); ++i) {
      place_.push(i);
      visit(array[i]);
      place_.pop();
    }
  }

  void warnEmpty() {
    report_.warn("empty array", place_.str(), "is empty, which glTF does not allow");
  }

  void walkText(const json& value, const Field& field) {
    if (!value.is_string()) failType(value, "a string");
    if (field.words.empty()) return;
    const std::string& text = value.get_ref<const std::string&>();
    const std::vector<std::string> words(field.words.begin(), field.words.end());
    if (std::find(words.begin(), words.end(), text) != words.end()) return;
    fail(fmt::format("'{}' is not valid; one of {} expected{}", text, listOf(words),
                     didYouMean(text, words)));
  }

  // Converts an integer written as 1.0.
  void toInteger(json& value, const std::string& expected) {
    if (value.is_number_integer()) return;
    if (!value.is_number_float()) failType(value, expected);
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > 9007199254740991.0) {
      fail(fmt::format("{} is not an integer; {} expected", textOf(number), expected));
    }
    report_.warn("integer as float", place_.str(), "an integer written with a decimal point");
    if (number < 0) {
      value = static_cast<int64_t>(number);
    } else {
      value = static_cast<uint64_t>(number);  // tinygltf reads sizes from unsigned numbers only
    }
  }

  void walkInteger(json& value, const Field& field) {
    toInteger(value, "an integer");
    if (!field.integers.empty()) {
      for (const int allowed : field.integers) {
        if (value == allowed) return;
      }
      fail(
          fmt::format("{} is not valid; one of {} expected", value.dump(), listOf(field.integers)));
    }
    const double number = value.get<double>();
    if (number < field.low || number > field.high) {
      fail(fmt::format("{} is out of range; {} to {} expected", value.dump(), field.low,
                       field.high));
    }
  }

  void walkNumber(json& value, const Field& field) {
    if (!value.is_number()) failType(value, "a number");
    const double number = value.get<double>();
    if (!(std::abs(number) <= FLT_MAX)) {
      fail(fmt::format("{} is too large for a 32-bit float", textOf(number)));
    }
    value = number;  // tinygltf cuts integers in extensions to 32 bits
    const bool tooLow = field.lowExcluded ? number <= field.low : number < field.low;
    if (!tooLow && number <= field.high) return;
    const std::string range =
        field.high == std::numeric_limits<double>::max()
            ? fmt::format("{} {:g}", field.lowExcluded ? "more than" : "at least", field.low)
            : fmt::format("{:g} to {:g}", field.low, field.high);
    if (field.outOfRange == OutOfRange::fails) {
      fail(fmt::format("{:g} is out of range; {} expected", number, range));
    }
    const double used =
        field.outOfRange == OutOfRange::clamps ? std::clamp(number, field.low, field.high) : number;
    report_.warn(
        "out of range", place_.str(),
        fmt::format("{:g} is out of range ({} expected); {:g} is used", number, range, used));
    value = used;
  }

  // Number of objects in the top-level array `target`; "a.b.c" descends into objects.
  size_t targetSize(std::string_view target) const {
    const json* value = &document_;
    while (true) {
      const size_t dot = target.find('.');
      const auto it = value->find(std::string(target.substr(0, dot)));
      if (it == value->end()) return 0;
      value = &*it;
      if (dot == std::string_view::npos) return value->is_array() ? value->size() : 0;
      if (!value->is_object()) return 0;
      target.remove_prefix(dot + 1);
    }
  }

  void walkReference(json& value, const Field& field) {
    toInteger(value, fmt::format("an index into {}", field.target));
    const size_t size = targetSize(field.target);
    if (value.is_number_unsigned() ? value.get<uint64_t>() < size
                                   : value >= 0 && value.get<uint64_t>() < size) {
      return;
    }
    fail(fmt::format("{} does not exist; {}", value.dump(),
                     size == 0
                         ? fmt::format("the file has no {}", field.target)
                         : fmt::format("the file has {}[0] to [{}]", field.target, size - 1)));
  }

  json& document_;
  Report& report_;
  Place place_;
  bool isDispensable_ = false;  // the walk is inside a dispensable field
};

}  // namespace

void validateDocument(json& document, Report& report) { Walker(document, report).walkDocument(); }

}  // namespace restlab::gltf
