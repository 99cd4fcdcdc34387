// Folders in which scenes and environments are looked for.
#pragma once

#include <filesystem>
#include <vector>

namespace restlab {

// In the order of the search: "" (as given), and for relative names RESTLAB_SCENES,
// ../shared/scenes and the scenes that were installed with the program.
std::vector<std::filesystem::path> sceneFoldersFor(const std::filesystem::path& name);

// Scenes that were installed with the program; empty in a build.
std::filesystem::path installedScenes();

}  // namespace restlab
