// Kolmogorov-Smirnov test of uniformity on [0, 1], to test p-values.
#pragma once

#include <span>

namespace restlab::stats {

struct KsResult {
  double statistic = 0.0;  // D: largest distance of the empirical distribution from the diagonal
  double pValue = 0.0;     // two-sided
};

// Throws std::invalid_argument without values, or for a value outside [0, 1] or NaN.
KsResult ksUniformTest(std::span<const double> values);

// Returns P(D_n >= d). Exact up to n = 400 (Durbin's matrix form), beyond by the limit distribution
// with Stephens's correction (relative error below 1 % for p in 1e-4..1).
double ksUpperTail(double d, size_t n);

}  // namespace restlab::stats
