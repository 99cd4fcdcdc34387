// `extras.restlab` of a glTF material: a kind of material and its parameters, as in a scene file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/gltf/report.h"
#include "core/scene/scene.h"

namespace restlab::gltf {

// The kinds of materials of a valid document, one each: TOML as [[material]] takes it, "" if the
// material has none. Throws Error (badInput).
std::vector<std::string> readClosures(const nlohmann::json& document, Report& report);

// Gives materials their kinds. `folder`: of the file, where tables and textures are. Throws Error
// (badInput).
void applyClosures(const std::vector<std::string>& closures, const std::filesystem::path& file,
                   Scene& scene);

}  // namespace restlab::gltf
