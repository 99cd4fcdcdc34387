// Declarations that are the same for all methods which resample paths by the passes of core/reuse.
#pragma once

#include <string>
#include <vector>

#include "core/frame/integrator.h"

namespace restlab {

// Returns a declaration that lacks its summary, its modes and what people see of its samples.
// `name`: its kernels are <name>_initial, <name>_temporal and so on; `reservoirUvec4s`: of a
// reservoir; `ofPaths`: its parameters besides those of the passes. A mode "biased" is the one that
// assumes visibility.
IntegratorInfo pathReuseMethod(const std::string& name, uint32_t reservoirUvec4s,
                               std::vector<ParameterInfo> ofPaths);

}  // namespace restlab
