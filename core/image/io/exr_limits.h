// Limits and names shared by the EXR reader and writer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace restlab {

constexpr uint32_t kExrMaxSide = 32768;
constexpr size_t kExrMaxPixels = size_t(1) << 28;  // over all layers: 3 GiB
constexpr const char* kExrMetadataPrefix = "restlab:";

// Throws Error (badUsage) if `layers` layers of this size exceed what a file may hold, and names
// the largest size of these proportions that fits. Called before rendering. `what` starts the line.
void requireExrSize(const std::string& what, uint32_t width, uint32_t height, uint32_t layers);

// Turns an OpenEXR message into part of one line: without line breaks and without the file name
// that it repeats ('Cannot open image file "x". Reason').
std::string exrReason(const std::string& message);

}  // namespace restlab
