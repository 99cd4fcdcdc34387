// Host side of the part that finds light that has changed.
#pragma once

#include "core/changes/changes.h"
#include "core/part.h"

namespace restlab {

// There where `validate_every` is not 0, of methods of which a part asks for kChanges. Its passes
// run before the integrator's.
const PartInfo& changesPartInfo();
constexpr const char* kValidateEvery = "validate_every";
// Its buffer, among the optional inputs of who reads it; ChangeParams::every is 0 where it is null.
constexpr const char* kChanges = "changes";
bool asksForChanges(const PartInfo& part);
rl::ChangeParams packChanges(const ParameterMap& parameters);

}  // namespace restlab
