// OpenEXR cube maps.
#pragma once

#include "core/image/image.h"

namespace restlab {

// Converts a cube to a latitude-longitude map. The cube: six square faces below each other, +X, -X,
// +Y, -Y, +Z, -Z as OpenEXR lays them out (ImfEnvmap.h). The result matches OpenEXR's exrenvmap: +Z
// in the middle, +X in the left half; four faces wide, each texel the mean of four bilinear
// samples.
Image latLongOfCube(const Image& cube);

}  // namespace restlab
