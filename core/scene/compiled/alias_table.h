// Alias tables: draw one of n entries by its weight in constant time (Walker 1977, Vose 1991).
#pragma once

#include <cstddef>
#include <vector>

#include "core/dialect/types.h"

namespace restlab {

// Builds a table over non-negative weights, not all zero, at most 2^31 of them. A kernel picks an
// entry as a cell of rows of `width` cells (a divisor of the number of weights): 32 bits for the
// column, 32 for the row if there are several, 32 for the threshold. `pmf` is the exact probability
// of that draw, up to float32. `pmf` differs from the normalised weight: thresholds are rounded to
// integers, and a positive weight gets at least 1 of 2^32. An estimator that divides by `pmf` is
// therefore unbiased for any range of weights. An entry of weight 0 is never drawn.
std::vector<rl::AliasEntry> buildAliasTable(const std::vector<double>& weights, size_t width);

}  // namespace restlab
