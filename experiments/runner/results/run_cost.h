// Cost of a run of a table relative to runs of other tables.
#pragma once

#include "experiments/runner/suite/suite.h"

namespace restlab {

// Returns frames times pixels times methods, without a unit. `suite`: from ofScene(). A side that
// depends on the camera is estimated from a 16:9 image.
double costOfRun(const Suite& suite, const SuiteScene& scene);

}  // namespace restlab
