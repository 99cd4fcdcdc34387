// Host side of the part that finds light that has changed.
#pragma once

#include "core/frame/part.h"
#include "core/temporal_gradients/changes.h"

namespace restlab {

// Part that finds changes; enabled if `validate_every` is not 0 and a part of the method follows
// them (PartInfo::followsChanges). The passes run before the integrator's.
const PartInfo& changesPartInfo();
constexpr const char* kValidateEvery = "validate_every";
// ChangeParams::every is 0 if no changes are found.
rl::ChangeParams packChanges(const ParameterMap& parameters);

}  // namespace restlab
