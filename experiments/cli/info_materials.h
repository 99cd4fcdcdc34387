// Materials of a scene that glTF does not have, for restlab info.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/scene.h"

namespace restlab {

// Name, kind and parameters of each material of a kind beside glTF's that an instance has.
nlohmann::ordered_json closuresOfScene(const Scene& scene);
// One line of the same: "clay: oren_nayar, color 0.7 0.45 0.3, sigma 0.6, model full".
std::string closureLine(const nlohmann::ordered_json& closure);

}  // namespace restlab
