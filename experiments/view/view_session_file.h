// Where sessions go.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

// A name of which the folder has neither a suite nor results: STEM, or STEM-2 and so on. No file is
// written over, and no run replaces the results of another one.
std::string freeSessionName(const std::filesystem::path& folder, const std::string& stem);

// Where the results of a suite of that name go, in the same folder.
std::filesystem::path resultsOfSession(const std::string& name);

}  // namespace restlab
