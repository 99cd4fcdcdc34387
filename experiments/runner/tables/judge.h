// Decides whether a row of a table counts, and flags what its numbers depend on.
#pragma once

#include "experiments/runner/tables/summary.h"

namespace restlab {

// Adds flags to a row, and clears `counts` if it has values that are not finite or contradicts its
// declared bias class.
void judge(MethodSummary& row);

}  // namespace restlab
