// Settings behind the name of a scene file: "material.wall.alpha=0.3&camera.yfov=60".
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene_file/scene_file.h"

namespace restlab {

// Stands before the keys of settings of the scene file that a file begins with.
constexpr const char* kOfBaseSetting = "base.";

// Returns the settings of a file itself, and those of its base.
std::pair<std::string, std::string> splitBaseSettings(const std::string& settings);
// Returns settings followed by more.
std::string joinedSettings(const std::string& settings, const std::string& more);
// Assigns settings of the file itself. The new kind of a material removes what it does not have.
// Throws Error with the setting.
void applySettings(const ConfigTable& table, const std::string& settings,
                   const std::filesystem::path& file);

// A [[material]] of a scene file (bases = 0), of the scene file that it begins with (1), and so on.
struct ListedMaterial {
  SceneFileMaterial material;
  uint32_t bases = 0;
};
// Reads the [[material]] tables of the file, then those of the scene files that it begins with.
// settings: as loadSceneFile(). Throws Error as that does.
std::vector<ListedMaterial> listMaterials(const std::filesystem::path& file,
                                          const std::string& settings);
// Returns the key of a setting behind the file's name: "base.material.wall.alpha".
std::string materialKey(uint32_t bases, const std::string& name, const std::string& parameter);

}  // namespace restlab
