// Reads the methods of a suite: [[method]] tables, for each combination of swept keys and each
// backend, and rows of images.
#pragma once

#include "core/base/config.h"
#include "experiments/runner/suite/suite.h"
#include "experiments/runner/suite/sweep.h"

namespace restlab {

// Fills `suite.methods`; the settings must have been read. `folder`: of the suite's file. Throws
// Error (badUsage) with the place.
void readMethods(const ConfigTable& root, const ConfigTable& settings, const Sweep& sweep,
                 const std::string& folder, Suite& suite);

}  // namespace restlab
