// Radiance inside furnaces: every surface Lambert of one albedo, emitting one radiance.
#pragma once

#include <cstdint>

namespace restlab::analytic {

// Radiance in a closed enclosure with paths of at most `scatteringEvents`: emission (1 + a + ... +
// a^n), in the unit of `emission`. albedo in [0, 1].
double furnaceRadiance(double emission, double albedo, uint32_t scatteringEvents);

// Radiance without a limit: emission / (1 - albedo); albedo in [0, 1).
double furnaceRadianceLimit(double emission, double albedo);

}  // namespace restlab::analytic
