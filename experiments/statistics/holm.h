// Holm's step-down correction for a family of tests.
#pragma once

#include <span>
#include <vector>

namespace restlab::stats {

// Returns adjusted p-values, in the given order. Rejecting those up to the family error bounds the
// chance of any false rejection by it, under any dependence between the tests. Throws
// std::invalid_argument for a p outside [0, 1] or NaN (leave untestable members out).
std::vector<double> holmAdjusted(std::span<const double> pValues);

// Returns which hypotheses are rejected at the family error.
std::vector<bool> holmReject(std::span<const double> pValues, double familyError);

}  // namespace restlab::stats
