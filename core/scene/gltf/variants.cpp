#include "core/scene/gltf/variants.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/gltf/json.h"

namespace restlab::gltf {
namespace {

using nlohmann::json;

constexpr const char* kVariants = "KHR_materials_variants";

std::string placeOfVariants(const std::string& place) {
  return fmt::format("{}{}extensions.{}", place, place.empty() ? "" : ".", kVariants);
}

const json* variantsOf(const json& object) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(kVariants);
  return found == extensions->end() ? nullptr : &*found;
}

const json& memberArray(const json& object, const char* key, const std::string& place,
                        Report& report) {
  const auto found = object.find(key);
  if (found == object.end()) report.fail(place, fmt::format("'{}' is missing", key));
  if (!found->is_array()) {
    report.fail(place + "." + key, fmt::format("is {}; an array expected", typeName(*found)));
  }
  return *found;
}

// Reads an index below `size`.
uint64_t indexBelow(const json& value, size_t size, const char* what, const std::string& place,
                    Report& report) {
  if (value.is_number_unsigned() && value.get<uint64_t>() < size) return value.get<uint64_t>();
  report.fail(place, fmt::format("is {}; an index below {}, the number of {}, expected",
                                 value.is_number() ? value.dump() : typeName(value), size, what));
}

// Names that can be read; others have no name to be called by.
std::vector<std::string> namesOf(const json* root) {
  std::vector<std::string> names;
  if (!root) return names;
  const auto list = root->find("variants");
  if (list == root->end() || !list->is_array()) return names;
  for (const json& one : *list) {
    if (one.is_object() && one.contains("name") && one.at("name").is_string())
      names.push_back(one.at("name").get<std::string>());
  }
  return names;
}

// Checks every variant; returns the index of the one with the name.
uint64_t findVariant(const json& root, const std::string& name, Report& report) {
  const std::string place = placeOfVariants("");
  const json& list = memberArray(root, "variants", place, report);
  std::optional<uint64_t> found;
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string own = fmt::format("{}.variants[{}]", place, i);
    if (!list[i].is_object() || !list[i].contains("name") || !list[i].at("name").is_string())
      report.fail(own, "has no name; an object with the string 'name' expected");
    if (list[i].at("name") != name) continue;
    if (found)
      report.fail(
          own, fmt::format("is named '{}' as variants[{}]; another name expected", name, *found));
    found = i;
  }
  if (found) return *found;
  const std::vector<std::string> names = namesOf(&root);
  report.fail(place, fmt::format("has no variant '{}'; {} expected{}", name,
                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                                 didYouMean(name, names)));
}

// Index of the material that a primitive has in the variant, if any.
std::optional<uint64_t> mappedMaterial(const json& extension, uint64_t variant, size_t variants,
                                       size_t materials, const std::string& place, Report& report) {
  std::optional<uint64_t> mapped;
  const json& mappings = memberArray(extension, "mappings", place, report);
  for (size_t i = 0; i < mappings.size(); ++i) {
    const std::string own = fmt::format("{}.mappings[{}]", place, i);
    if (!mappings[i].is_object() || !mappings[i].contains("material"))
      report.fail(own, "has no material; an object with 'material' and 'variants' expected");
    const uint64_t material =
        indexBelow(mappings[i].at("material"), materials, "materials", own + ".material", report);
    const json& list = memberArray(mappings[i], "variants", own, report);
    for (size_t v = 0; v < list.size(); ++v) {
      const std::string at = fmt::format("{}.variants[{}]", own, v);
      if (indexBelow(list[v], variants, "variants", at, report) != variant) continue;
      if (mapped)
        report.fail(
            at, fmt::format("variant {} has a material in another mapping; one expected", variant));
      mapped = material;
    }
  }
  return mapped;
}

}  // namespace

std::vector<std::string> applyVariant(json& document, const std::optional<std::string>& name,
                                      Report& report) {
  const json* root = variantsOf(document);
  const std::vector<std::string> names = namesOf(root);
  if (!name) {
    if (root) {
      report.warn("variants", placeOfVariants(""),
                  names.empty() ? "has no variant with a name; default materials are drawn"
                                : fmt::format("default materials are drawn; --variant takes one of "
                                              "{}",
                                              fmt::join(names, ", ")));
    }
    return names;
  }
  if (!root) {
    report.fail("", fmt::format("has no variants ({}); the file without '{}' expected", kVariants,
                                "?variant=" + *name));
  }
  const uint64_t variant = findVariant(*root, *name, report);
  const size_t variants = root->at("variants").size();
  const size_t materials = arrayOf(document, "materials").size();
  const size_t meshes = arrayOf(document, "meshes").size();
  for (size_t m = 0; m < meshes; ++m) {
    json& primitives = document["meshes"][m]["primitives"];
    for (size_t p = 0; p < primitives.size(); ++p) {
      const json* extension = variantsOf(primitives[p]);
      if (!extension) continue;
      const std::string place = placeOfVariants(fmt::format("meshes[{}].primitives[{}]", m, p));
      const std::optional<uint64_t> material =
          mappedMaterial(*extension, variant, variants, materials, place, report);
      if (material) primitives[p]["material"] = *material;
    }
  }
  return names;
}

}  // namespace restlab::gltf
