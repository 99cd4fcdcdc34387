// Versions of the libraries that images and times depend on.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace restlab {

// Returns name and version ("Embree", "3.13.5"): the version of the headers at build time, but for
// TBB the version at run time.
std::vector<std::pair<std::string, std::string>> libraryVersions();

}  // namespace restlab
