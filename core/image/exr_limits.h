// What the EXR reader and writer agree on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace restlab {

constexpr uint32_t kExrMaxSide = 32768;
constexpr size_t kExrMaxPixels = size_t(1) << 28;  // over all layers: 3 GiB
constexpr const char* kExrMetadataPrefix = "restlab:";

// Throws Error (badUsage) where `layers` layers of this size are more than a file may hold, with
// the largest size of these proportions that would do: asked before rendering. `what` starts the
// line.
void requireExrSize(const std::string& what, uint32_t width, uint32_t height, uint32_t layers);

// An OpenEXR message as part of one line: without line breaks and without the file name that it
// repeats ('Cannot open image file "x". Reason').
std::string exrReason(const std::string& message);

}  // namespace restlab
