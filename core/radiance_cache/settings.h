// Host side of the cells of radiance.
#pragma once

#include <string>
#include <vector>

#include "core/frame/part.h"
#include "core/radiance_cache/radiance.h"

namespace restlab {

// Part that keeps the cells; enabled if the parameter `secondary` is "cache". The passes run before
// the integrator's.
const PartInfo& radiancePartInfo();
// Returns whether paths end in cells, with these resolved parameters.
bool endsPaths(const ParameterMap& parameters);
// Packs RadianceParams for an integrator. All zero if its paths do not end in cells.
rl::RadianceParams packRadiance(const ParameterMap& parameters);

}  // namespace restlab
