// The method that ratios are against, by the name that a suite or a command gives it.
#pragma once

#include "core/config.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Completes `suite.baseline`. It may be a method's name, its name without the backend, or its name
// with numbers written in another way ("radius=8" of "radius=8.0"); then it becomes the method's
// own. Throws Error (badUsage) with place where it is none of these.
void followBaseline(const ConfigTable& settings, Suite& suite);

}  // namespace restlab
