// The cost of a run of a table relative to runs of other tables.
#pragma once

#include "experiments/runner/suite/suite.h"

namespace restlab {

// Frames times pixels times methods, in no unit. `suite` is that of the scene (ofScene). A side
// that the camera decides is taken as that of an image of 16 to 9.
double costOfRun(const Suite& suite, const SuiteScene& scene);

}  // namespace restlab
