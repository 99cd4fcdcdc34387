// Small scenes in which `bdpt` and `path` are compared: each has a kind of light or of surface that
// other strategies find, or that only one of them can.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/compiled/compiled_scene.h"

namespace restlab::bias {

struct BdptScene {
  const char* name;
  std::function<Scene()> make;
};

// A room with a block and a ball under a lamp that shines to both sides, near the middle.
Scene bdptRoom(const std::string& name, const rl::Material& block, const rl::Material& ball,
               bool hasLamp = true);

const std::vector<BdptScene>& bdptScenes();

}  // namespace restlab::bias
