// Checks of a glTF document before anything reads it.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// Compares the document with the schema: types, ranges, required properties, references. Fails on
// content that cannot be read. Clamps numbers outside the range of a material property in `json`
// and converts integers written as 1.0, both with a warning. Warns of unknown properties.
void validateDocument(nlohmann::json& json, Report& report);

// Checks the asset's version and its extensions: fails on required extensions that are not
// supported, warns of used ones.
void checkVersionAndExtensions(const nlohmann::json& json, Report& report);

}  // namespace restlab::gltf
