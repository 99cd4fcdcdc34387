// Versions of the libraries that images and times depend on.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace restlab {

// Name and version ("Embree", "3.13.5"). Those of the headers this was built with, but for TBB,
// which says its own while it runs.
std::vector<std::pair<std::string, std::string>> libraryVersions();

}  // namespace restlab
