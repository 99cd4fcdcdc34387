// Rules of glTF that connect several properties, checked on the JSON before tinygltf reads it:
// it accepts or misreports most of their violations.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/gltf_report.h"

namespace restlab::gltf {

// Of a document that validateDocument() accepted. Fails or warns.
void checkRules(const nlohmann::json& document, Report& report);

// One warning each for what is present but not imported: animations, skins, morph targets, further
// scenes.
void warnNotImported(const nlohmann::json& document, Report& report);

}  // namespace restlab::gltf
