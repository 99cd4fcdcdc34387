// Host side of the cells of radiance.
#pragma once

#include <string>
#include <vector>

#include "core/part.h"
#include "core/radiance/radiance.h"

namespace restlab {

// The part that keeps the cells: there where the parameter `secondary` is "cache". Its passes run
// before the integrator's.
const PartInfo& radiancePartInfo();
// Do paths end in cells, with these resolved parameters?
bool endsPaths(const ParameterMap& parameters);
// The buffers that an integrator whose paths end in cells has among its optional inputs, in the
// order of rl::RadianceBuffers.
std::vector<std::string> radianceInputs();
// For such an integrator. All zero where its paths do not end in cells.
rl::RadianceParams packRadiance(const ParameterMap& parameters);

}  // namespace restlab
