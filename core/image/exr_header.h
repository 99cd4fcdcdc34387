// The header of an EXR file, read before OpenEXR allocates anything from its numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace restlab {

// Throws Error (badInput): the file and what is wrong with it.
[[noreturn]] void failExr(const std::filesystem::path& file, const std::string& what);

// Walks over the raw header: attribute sizes, the data window and the tile size may all lie. Where
// OpenEXR would not take an attribute's size at its word it would read on elsewhere than this does,
// and find sizes that nobody checked: refused. Returns the pixels of the data window.
uint64_t checkExrHeader(const std::filesystem::path& file, std::ifstream& stream,
                        uint64_t fileBytes);

}  // namespace restlab
