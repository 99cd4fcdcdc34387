// Rules of glTF that connect several properties, checked on the JSON before tinygltf reads it:
// tinygltf accepts or misreports most violations.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// Checks a document that validateDocument() accepted. Fails or warns.
void checkRules(const nlohmann::json& document, Report& report);

// Warns once for each kind of content that is not imported: animations, skins, morph targets,
// further scenes.
void warnNotImported(const nlohmann::json& document, Report& report);

}  // namespace restlab::gltf
