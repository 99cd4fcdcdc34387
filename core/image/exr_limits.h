// What the EXR reader and writer agree on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace restlab {

constexpr uint32_t kExrMaxSide = 32768;
constexpr size_t kExrMaxPixels = size_t(1) << 28;  // over all layers: 3 GiB
constexpr const char* kExrMetadataPrefix = "restlab:";

// An OpenEXR message as part of one line: without line breaks and without the file name that it
// repeats ('Cannot open image file "x". Reason').
std::string exrReason(const std::string& message);

}  // namespace restlab
