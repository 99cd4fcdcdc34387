// Expected number of draws of each light of a scene. Two halves of few samples agree if both miss a
// light; the light table's probabilities and the number of rays warn of that, without a counter in
// any kernel.
#pragma once

#include <string>
#include <vector>

#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

// Light as a user knows it: all triangles of an emitting object, a punctual light, or the
// environment.
struct DrawnLight {
  std::string name;
  double probability = 0.0;  // that a draw selects it and hits a lit texel; above 0
};

// Lists the lights that are on, in the order of the light table. A draw of an emitting object lands
// anywhere on it. A textured object counts by the share (mean L)^2 / mean L^2, where L is the
// luminance of all texels of the image: with one bright texel of 4096, one draw in 4096 is useful.
// Environments are drawn by texel.
std::vector<DrawnLight> drawnLights(const CompiledScene& scene);

// With fewer expected draws over the whole image, the estimated error of a reference may miss the
// light's share: the mean of 1000 events is known to 3 %.
constexpr double kFewestLightDraws = 1000.0;
// With fewer expected draws a light may be missed entirely, with probability e^-10.
constexpr double kHardlyDrawn = 10.0;

struct RareLights {
  std::vector<DrawnLight> lights;  // drawn less often than kFewestLightDraws, the rarest first
  double fewestDraws = 0.0;        // of the rarest light, whether it counts as rare or not
  double sppNeeded = 0.0;          // until no light is rare; 0: no light is on
};

// `lights`: from drawnLights(). `rays`: path rays of all samples so far, at `spp` samples per
// pixel. A vertex draws one light and takes at least one path ray to reach, so a light's draws are
// at most its probability times the rays.
RareLights rareLights(const std::vector<DrawnLight>& lights, double rays, double spp);

// Returns "2 of 7 lights were drawn too seldom to know their share ('lamp' 0.05 times, ...)"; "" if
// no light is rare.
std::string rareLightsText(const RareLights& rare, size_t lights, double rays);

}  // namespace restlab
