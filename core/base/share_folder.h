// Folder of what is installed with the program: suites and their scenes.
#pragma once

#include <filesystem>

namespace restlab {

// File that holds this code: the program, or librestlab.so in another program.
std::filesystem::path fileOfThisCode();

// ../share/restlab or ../../share/restlab, seen from the folder of fileOfThisCode(): found wherever
// the installed tree was moved. Empty where neither has suites, as in a build.
const std::filesystem::path& shareFolder();

}  // namespace restlab
