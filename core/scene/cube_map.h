// Cube maps of OpenEXR.
#pragma once

#include "core/image/image.h"

namespace restlab {

// Six square faces below each other, +X, -X, +Y, -Y, +Z, -Z as OpenEXR lays them out
// (ImfEnvmap.h), as the latitude-longitude map that its exrenvmap makes: +Z is in the middle, +X in
// the left half. Four faces wide, each texel the mean of four bilinear samples.
Image latLongOfCube(const Image& cube);

}  // namespace restlab
