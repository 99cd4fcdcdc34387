// Where sessions go.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

// Writes to STEM.toml in the folder, or STEM-2.toml and so on: no file is written over.
// Returns its name. Throws Error (badInput) where none can be written.
std::string writeSession(const std::filesystem::path& folder, const std::string& toml,
                         const std::string& stem);

}  // namespace restlab
