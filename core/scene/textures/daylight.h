// Sun and clear sky as an environment: Preetham, Shirley and Smits 1999, "A Practical Analytic
// Model for Daylight".
#pragma once

#include <string>

#include "core/scene/scene.h"

namespace restlab {

struct Daylight {
  double elevation = 45.0;  // degrees of the sun above the horizon, 1 to 90
  double azimuth = 0.0;     // degrees from -Z towards +X
  double turbidity = 3.0;   // haze: 2 (very clear) to 10
  double ground = 0.2;      // albedo of the level plane that fills the lower half, 0 to 1
  double sun = 1.0;         // factor on the sun's disc, 0 to 1
};

// Luminance (kcd/m^2) and chromaticities x, y of the sky without the sun, towards a unit direction
// above the horizon.
glm::dvec3 skyYxy(const Daylight& daylight, const glm::dvec3& dirW);

// Radiance in Rec. 709 whose luminance is in kcd/m^2. The sun's disc (0.533 degrees) is in the
// texels; the sum over them does not depend on their number. The lower half is the light that the
// ground scatters. Ozone and water vapour are left out.
EnvironmentMap daylightMap(const Daylight& daylight, uint32_t width = 2048, uint32_t height = 1024);

// Returns whether a name asks for daylight: "daylight" or "daylight?elevation=30&turbidity=4".
bool isDaylightName(const std::string& name);

// Throws Error (badInput) for parameters that are unknown, repeated or out of range.
Daylight parseDaylight(const std::string& name);

}  // namespace restlab
