// NAME.scene.toml: a scene, and what is other in it (docs/scenes.md).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/config.h"
#include "core/scene/scene.h"
#include "core/scene/closure_info.h"

namespace restlab {

// Returns whether a path ends in .scene.toml.
bool isSceneFile(const std::filesystem::path& file);

// Reads the file and the scene that it begins with. settings: "material.wall.roughness=0.3&..." as
// behind the '?' of its name. Throws Error (badInput) with one line: file:line:column, what is
// wrong, the nearest name.
Scene loadSceneFile(const std::filesystem::path& file, const std::string& settings = "");

// The file in "x.scene.toml?material.wall.roughness=0.3", and what follows its '?' ("": nothing).
// Names of other scenes stay whole.
std::pair<std::string, std::string> splitSceneSettings(const std::string& name);

// Returns what follows the '?' behind the file of a scene that was loaded: settings, definitions,
// the variant; "" for a built-in scene. Does not take Scene::name, which has no extension, for the
// name of a built-in scene.
std::string settingsOfScene(const Scene& scene);

// Lists the files that a scene was made from: its own and, where that is a scene file, those that
// it begins with. Files that cannot be read end the list.
std::vector<std::filesystem::path> filesOfScene(const Scene& scene);

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

// A [[material]] of a scene file, as it is written there.
struct SceneFileMaterial {
  std::string name;
  const MaterialKind* kind = nullptr;
  std::vector<std::string> values;  // TOML of each parameter of the kind; "": it has none
};
std::vector<SceneFileMaterial> materialsOf(const ConfigTable& table);
// Reads the [[material]] tables of the file itself, not of a scene file that it begins with.
// settings: as loadSceneFile(). Throws Error as that does.
std::vector<SceneFileMaterial> sceneFileMaterials(const std::filesystem::path& file,
                                                  const std::string& settings);

// How a material scatters: what takes the place of another's lobes.
struct Scattering {
  std::string name;
  const MaterialKind* kind = nullptr;
  rl::Material lobes{};               // of a kind that the lobes of glTF stand for
  std::vector<ClosureValue> closure;  // else, or of layers of glTF
  glm::vec3 sigmaScattering{0.0f};    // SceneMaterial
  float phase = 0.0f;
  bool hasDiffusion = false;
  uint32_t flags = 0;  // RL_MATERIAL_BLACK, _THIN, _ANISOTROPIC, _LAYERS
};

// The things that parameters name: images and tables relative to `folder`, read once each and added
// to the scene, and materials.
class SceneFileInputs {
 public:
  SceneFileInputs(std::filesystem::path folder, Scene& scene) : folder_(folder), scene_(scene) {}
  // Index of a use of the file's image. Throws Error (badInput) at `place`, as the next two.
  uint32_t addTexture(const std::string& file, TextureUse use, const std::string& place);
  // Index into Scene::tables.
  uint32_t addTable(const std::string& file, const std::string& place);
  // Index into Scene::materials of a part of a mixture, one of those that were offered.
  uint32_t addPart(const std::string& name, const std::string& place);

  // RL_MATERIAL_* of a part.
  uint32_t flagsOf(uint32_t part) const { return scene_.materials.at(part).data.flags; }

  void offer(const Scattering& material) { offered_.push_back(material); }
  // A table that stands for a file.
  void offer(std::shared_ptr<const ClosureTable> table);

 private:
  using Indices = std::vector<std::pair<std::filesystem::path, uint32_t>>;
  std::filesystem::path folder_;
  Scene& scene_;
  Indices images_;  // into Scene::images
  Indices tables_;  // into Scene::tables
  Indices parts_;   // into Scene::materials
  std::vector<Scattering> offered_;
};

// Reads a [[material]] table.
Scattering readScattering(const ConfigTable& table, SceneFileInputs& inputs);
// Gives a material that scattering. Emission, coverage, sides and the normal map stay.
void scatterAs(const Scattering& scattering, SceneMaterial& material);

}  // namespace restlab
