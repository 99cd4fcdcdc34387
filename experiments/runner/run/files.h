// Result folders and the search for scenes and environments.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

// Makes a directory and its parents; throws Error (badInput) when it cannot be written to.
void makeWritableDirectory(const std::filesystem::path& directory);

// `name` as given (a scene's extension may be left out), else under RESTLAB_SCENES, else under
// ../shared/scenes; empty when nowhere.
std::filesystem::path findAsset(const std::string& name);

// The folder of scenes of others: RESTLAB_SCENES, else ../shared/scenes; empty when absent.
std::filesystem::path sceneFolder();

// The file that a name leads to, through links and other spellings of its folder, whether it is
// there or not yet.
std::filesystem::path resolvedPath(const std::filesystem::path& name);

// A name that is safe as part of a file name: letters and digits of any script (UTF-8), '.', '_',
// '-'.
std::string safeFileName(const std::string& name);

// An id of such a name, of ASCII alone, as reports and addresses take it. Letters of other scripts
// become '_', and a hash of the name behind it keeps ids of different names apart.
std::string plainId(const std::string& safeName);

}  // namespace restlab
