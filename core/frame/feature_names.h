// Names of the features of a scene or a kernel (core/dialect/features.h).
#pragma once

#include <cstdint>
#include <string>

namespace restlab {

// Formats features for reports: "textures+alpha", "none".
std::string featureNames(uint32_t mask);

}  // namespace restlab
