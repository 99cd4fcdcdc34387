// Decides whether a row of a table counts, and flags what its numbers depend on.
#pragma once

#include "experiments/runner/tables/summary.h"

namespace restlab {

// Returns whether the method differs from an image in closed form by no more than that image's own
// error. Runs without noise, such as those of paths that all end alike, would show it as a bias.
// Reads `block`, `mse` and `energyRatio` of the row.
bool isExactEnough(const MethodSummary& row);

// Adds flags to a row, and clears `counts` if it has values that are not finite or contradicts its
// declared bias class.
void judge(MethodSummary& row);

}  // namespace restlab
