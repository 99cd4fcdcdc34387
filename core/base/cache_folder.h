// Folder of what the program keeps for later runs of a user.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

// $XDG_CACHE_HOME/restlab/NAME or ~/.cache/restlab/NAME; empty where neither variable is an
// absolute path.
std::filesystem::path cacheFolder(const std::string& name);

}  // namespace restlab
