// Names of the features of a scene or a kernel (core/dialect/features.h).
#pragma once

#include <string>

#include "core/dialect/features.h"

namespace restlab {

// Formats features for reports: "textures+alpha", "none".
std::string featureNames(rl::FeatureMask mask);

}  // namespace restlab
