// Results folders and the search for scenes and environments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace restlab {

// Creates a directory and its parents. Throws Error (badInput) if it cannot be written to.
void makeWritableDirectory(const std::filesystem::path& directory);

// Finds `name` as given (a scene's extension may be left out), else in one of sceneFoldersFor().
// Returns an empty path if not found.
std::filesystem::path findAsset(const std::string& name);

// Returns whether a name is that of a suite: a .toml that is no scene file.
bool isSuite(const std::string& name);

// Finds a suite as given, else among those that were installed with the program, where its name may
// lack ".toml". Returns `name` if there is none.
std::filesystem::path findSuite(const std::filesystem::path& name);

// Names of the installed suites, without ".toml"; none in a build.
std::vector<std::string> installedSuites();

// Returns the folder of downloaded scenes: RESTLAB_SCENES, else ../shared/scenes; empty if absent.
std::filesystem::path sceneFolder();

// Resolves links and other spellings of a file's folder. The file need not exist.
std::filesystem::path resolvedPath(const std::filesystem::path& name);

// Makes a name safe as part of a file name: letters and digits of any script (UTF-8), '.', '_',
// '-'.
std::string safeFileName(const std::string& name);

// Makes an ASCII id of a safe name, for reports and URLs. Letters of other scripts become '_', and
// a hash of the name is appended to keep ids of different names apart.
std::string plainId(const std::string& safeName);

}  // namespace restlab
