// How often light sampling is expected to have drawn each light of a scene. Two halves of few
// samples agree where both miss a light; the light table's probabilities and the number of rays
// tell that it can be so, without a counter in any kernel.
#pragma once

#include <string>
#include <vector>

#include "core/scene/compiled_scene.h"

namespace restlab {

// A light as a user knows it: all triangles of an emitting object, a punctual light, or the
// environment.
struct DrawnLight {
  std::string name;
  double probability = 0.0;  // that one draw selects it and finds where it shines; above 0
};

// Lists the lights that are on, in the order of the light table. A draw of an emitting object lands
// anywhere on it. Under a texture it counts by the share (mean L)^2 / mean L^2, L being the
// luminance of all texels of the image: one bright texel of 4096 has one useful draw in 4096.
// Environments are drawn by texel.
std::vector<DrawnLight> drawnLights(const CompiledScene& scene);

// Below this many expected draws over the whole image the error of a reference is not known to hold
// the light's share: a mean of 1000 events is known to 3 %.
constexpr double kFewestLightDraws = 1000.0;
// Below this many a light may never have been drawn: by chance it is not with e^-10.
constexpr double kHardlyDrawn = 10.0;

struct RareLights {
  std::vector<DrawnLight> lights;  // drawn less often than kFewestLightDraws, the rarest first
  double fewestDraws = 0.0;        // of the first of them; of any light where there is none
  double sppNeeded = 0.0;          // until none is left; 0: no light is on
};

// `lights` as drawnLights() has them; `rays`: path rays of all samples so far, `spp` of them a
// pixel. A vertex draws one light, and takes at least one path ray to be found, so that draws are
// at most the probability times the rays.
RareLights rareLights(const std::vector<DrawnLight>& lights, double rays, double spp);

// "2 of 7 lights were drawn too seldom to know their share ('lamp' 0.05 times, ...)"; "" where none
// is rare.
std::string rareLightsText(const RareLights& rare, size_t lights, double rays);

}  // namespace restlab
