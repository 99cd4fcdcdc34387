// Built-in scenes for tests that run each method on all of them.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::test {

// Leaves out scenes of one shape: the gallery `shapes` has all of these kinds.
inline std::vector<std::string> variedScenes() {
  constexpr std::array kOfOneShape{"shape-furnace", "ball", "teapot", "implicit", "sdf", "hair"};
  std::vector<std::string> names = builtinSceneNames();
  std::erase_if(names, [&](const std::string& name) {
    return std::find(kOfOneShape.begin(), kOfOneShape.end(), name) != kOfOneShape.end();
  });
  return names;
}

}  // namespace restlab::test
