// Whether a row of a table counts, and what its numbers depend on.
#pragma once

#include "experiments/runner/summary/summary.h"

namespace restlab {

// Adds flags to a row, and takes `counts` from one whose values are not finite or that is not what
// its bias class declares.
void judge(MethodSummary& row);

}  // namespace restlab
