// Finds the method that ratios are relative to by the name given in a suite or command.
#pragma once

#include "core/base/config.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Replaces `suite.baseline` by the exact name of a method. It may be given as a method's name, its
// name without the backend, or with numbers in another notation ("radius=8" for "radius=8.0").
// Throws Error (badUsage) with the place if no method matches.
void followBaseline(const ConfigTable& settings, Suite& suite);

}  // namespace restlab
