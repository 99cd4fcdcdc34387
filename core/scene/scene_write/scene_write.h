// A scene file that names each material of a scene with its kind and parameters, to be edited.
#pragma once

#include <filesystem>
#include <string>

#include "core/scene/scene.h"

namespace restlab {

struct SceneFileText {
  std::string text;       // of NAME.scene.toml
  size_t named = 0;       // materials that the file assigns
  size_t commentary = 0;  // materials in comments: a scene file does not hold all of them
};

// Writes what begins with the scene and gives each of its materials to itself, so that the file
// shows the same image. `base`: the scene as the file names it. A material that would change is
// written as a comment that says why.
SceneFileText sceneFileOf(const Scene& scene, const std::string& base);

// The scene's name for a scene file in `folder`: a built-in's, or a path relative to the folder.
std::string baseNameOf(const Scene& scene, const std::filesystem::path& folder);

}  // namespace restlab
