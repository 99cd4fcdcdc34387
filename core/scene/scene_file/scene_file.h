// NAME.scene.toml: a scene, and what is other in it (docs/scenes.md).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/config.h"
#include "core/scene/scene.h"
#include "core/scene/closure_info.h"

namespace restlab {

// Returns whether a path ends in .scene.toml.
bool isSceneFile(const std::filesystem::path& file);

// Reads the file and the scene that it begins with. Throws Error (badInput) with one line:
// file:line:column, what is wrong, the nearest name.
Scene loadSceneFile(const std::filesystem::path& file);

// A kind of material, as [[material]] and the list of the program name it: a closure, or one that
// the lobes of glTF stand for.
struct MaterialKind {
  std::string name;
  std::string summary;
  std::string source;
  std::vector<ClosureParameter> parameters;
  const ClosureInfo* closure = nullptr;  // nullptr: the lobes of glTF
};
const std::vector<MaterialKind>& materialKinds();

// Images that parameters name: relative to `folder`, decoded once each, and added to the scene.
class SceneFileTextures {
 public:
  SceneFileTextures(std::filesystem::path folder, Scene& scene) : folder_(folder), scene_(scene) {}
  // Index of a new texture use. Throws Error (badInput) at `place`.
  uint32_t add(const std::string& file, bool isSrgb, uint32_t uvSet, const std::string& place);

 private:
  std::filesystem::path folder_;
  Scene& scene_;
  std::vector<std::pair<std::filesystem::path, uint32_t>> images_;  // index into Scene::images
};

// How a material scatters: what takes the place of another's lobes.
struct Scattering {
  std::string name;
  const MaterialKind* kind = nullptr;
  rl::Material lobes{};               // of a kind that the lobes of glTF stand for
  std::vector<ClosureValue> closure;  // else
  uint32_t flags = 0;                 // RL_MATERIAL_BLACK, _THIN, _ANISOTROPIC
};

// Reads a [[material]] table.
Scattering readScattering(const ConfigTable& table, SceneFileTextures& textures);
// Gives a material that scattering. Emission, coverage, sides and the normal map stay.
void scatterAs(const Scattering& scattering, SceneMaterial& material);

}  // namespace restlab
