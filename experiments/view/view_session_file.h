// Names of the files and folders of saved sessions.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

// Returns a name for which the folder has neither a suite nor results: STEM, STEM-2, ... No file is
// overwritten, and no run replaces the results of another one.
std::string freeSessionName(const std::filesystem::path& folder, const std::string& stem);

// Folder of the results of a suite, relative to the suite's folder.
std::filesystem::path resultsOfSession(const std::string& name);

}  // namespace restlab
