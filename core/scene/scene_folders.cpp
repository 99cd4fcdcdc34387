#include "core/scene/scene_folders.h"

#include <cstdlib>

#include "core/base/share_folder.h"

namespace restlab {

namespace fs = std::filesystem;

std::vector<fs::path> sceneFoldersFor(const fs::path& name) {
  std::vector<fs::path> folders = {""};
  if (name.is_absolute()) return folders;
  const char* scenes = std::getenv("RESTLAB_SCENES");
  if (scenes != nullptr && *scenes != '\0') folders.emplace_back(scenes);
  folders.emplace_back("../shared/scenes");
  if (const fs::path installed = installedScenes(); !installed.empty())
    folders.push_back(installed);
  return folders;
}

fs::path installedScenes() { return shareFolder().empty() ? fs::path() : shareFolder() / "scenes"; }

}  // namespace restlab
