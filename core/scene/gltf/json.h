// Helpers to read a JSON document.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace restlab::gltf {

// Name of the value's type for error lines: "an array", "a string".
inline std::string typeName(const nlohmann::json& value) {
  if (value.is_array()) return "an array";
  if (value.is_object()) return "an object";
  if (value.is_null()) return "null";
  if (value.is_number_integer()) return "an integer";
  return fmt::format("a {}", value.type_name());
}

// A top-level array, empty when absent.
inline const nlohmann::json& arrayOf(const nlohmann::json& document, const char* key) {
  static const nlohmann::json kNone = nlohmann::json::array();
  const auto it = document.find(key);
  return it == document.end() ? kNone : *it;
}

// Reads a non-negative integer; `otherwise` if absent.
inline uint64_t sizeOf(const nlohmann::json& object, const char* key, uint64_t otherwise) {
  const auto it = object.find(key);
  return it == object.end() ? otherwise : it->get<uint64_t>();
}

}  // namespace restlab::gltf
