// Equivalence by two one-sided t-tests: rejects the hypothesis that the means differ by a margin or
// more. A t-test that does not reject proves no equivalence.
#pragma once

#include "experiments/statistics/welch.h"

namespace restlab::stats {

struct TostResult {
  double pLower = 0.0;  // of "difference <= -margin"
  double pUpper = 0.0;  // of "difference >= +margin"
  double pValue = 0.0;  // the larger: below alpha, the means are equivalent
  double dof = 0.0;
  double lo = 0.0, hi = 0.0;  // 1 - 2 alpha interval of the difference; inside the margins if and
                              // only if pValue < alpha
};

// Throws std::invalid_argument unless margin > 0 and 0 < alpha < 0.5.
TostResult tostTest(const Sample& a, const Sample& b, double margin, double alpha = 0.05);

}  // namespace restlab::stats
