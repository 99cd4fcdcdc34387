// The header of an EXR file, read before OpenEXR allocates anything from its numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace restlab {

// Throws Error (badInput) with the file and the fault.
[[noreturn]] void failExr(const std::filesystem::path& file, const std::string& what);

// Checks the raw header: attribute sizes, the data window and the tile size may all be wrong.
// Refuses an attribute whose declared size differs from what OpenEXR reads: OpenEXR would continue
// at another place than this check and find unchecked sizes. Returns the number of pixels of the
// data window.
uint64_t checkExrHeader(const std::filesystem::path& file, std::ifstream& stream,
                        uint64_t fileBytes);

}  // namespace restlab
