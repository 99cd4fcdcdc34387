// Checks of a glTF document before anything reads it.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/gltf_report.h"

namespace restlab::gltf {

// Compares the document with the schema: types, ranges, required properties, references. Fails on
// what cannot be read. Numbers outside the range of a material property are clamped in `json`,
// integers written as 1.0 become integers; both with a warning, as have unknown properties.
void validateDocument(nlohmann::json& json, Report& report);

// The asset's version, and the extensions: required ones that are not supported fail, used ones
// warn.
void checkVersionAndExtensions(const nlohmann::json& json, Report& report);

}  // namespace restlab::gltf
