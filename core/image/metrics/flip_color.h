// Colour spaces of FLIP and the tone mapper of its HDR variant.
#pragma once

#include <glm/glm.hpp>

namespace restlab::flip {

// Linear Rec. 709 to YyCxCz, the linear relative of CIELAB in which contrast sensitivity is
// defined: Yy in 0..100 for luminance in 0..1 (at -16 for black), Cx red-green, Cz blue-yellow.
glm::dvec3 opponentFromLinear(const glm::dvec3& linear);
glm::dvec3 linearFromOpponent(const glm::dvec3& opponent);

// CIELAB with chroma that fades towards black (the Hunt effect): a and b times L / 100.
glm::dvec3 huntLabFromLinear(const glm::dvec3& linear);

// Tone maps radiance to linear values by Narkowicz's fit of ACES (2015), clipped to 0..1; negative
// radiance gives 0, NaN stays.
double toneMap(double radiance);

// Inverse of toneMap() for `shown` in 0..1.
double radianceShownAs(double shown);

}  // namespace restlab::flip
