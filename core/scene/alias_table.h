// Alias tables: one of n entries by its weight, in constant time (Walker 1977, Vose 1991).
#pragma once

#include <cstddef>
#include <vector>

#include "core/dialect/types.h"

namespace restlab {

// A table over non-negative weights, not all zero, at most 2^31, whose entries a kernel picks as
// cells of rows of `width` (a divisor of their number): 32 bits for the column, 32 for the row
// where there are several, 32 for the threshold. `pmf` is the exact probability of that draw, up
// to float32, and not the weight: thresholds are rounded to integers, and a positive weight gets
// at least 1 of 2^32. So an estimator that divides by pmf has no bias, however far apart the
// weights are. An entry of weight 0 is never drawn.
std::vector<rl::AliasEntry> buildAliasTable(const std::vector<double>& weights, size_t width);

}  // namespace restlab
