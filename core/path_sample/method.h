// Declarations that are the same for all methods which resample paths by the passes of core/reuse.
#pragma once

#include <string>
#include <vector>

#include "core/frame/integrator.h"

namespace restlab {

// Returns a declaration that lacks its summary and what people see of its samples. `name`: its
// kernels are <name>_initial, <name>_temporal and so on; `reservoirUvec4s`: of a reservoir;
// `ofPaths`: its parameters besides those of the passes; `ofShift`: for people, what its shifts
// do that makes the mode "unbiased" so; "" or a phrase that ends with a comma and a space. The mode
// "biased" assumes visibility.
IntegratorInfo pathReuseMethod(const std::string& name, uint32_t reservoirUvec4s,
                               std::vector<ParameterInfo> ofPaths, const std::string& ofShift);

}  // namespace restlab
