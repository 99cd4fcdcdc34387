// Chi-squared goodness of fit for sampling routines.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace restlab::stats {

struct Chi2Result {
  double statistic = 0.0;
  double dof = 0.0;         // cells after pooling, less one
  double pValue = 0.0;      // 0 when `impossible` or `excess` is set
  uint64_t failures = 0;    // samples outside all cells
  bool impossible = false;  // a hit where the probability is 0
  bool excess = false;      // the probabilities sum to more than 1 + tolerance
  std::string summary;      // one line for a failing test
};

// Tests `samples` draws, of which counts[i] fell in cell i, against the cells' probabilities
// (integrals of the pdf, so that their sum is 1 or less). Draws outside all cells (failed or
// absorbed) are counted in an extra cell with the remaining probability. Cells that expect fewer
// than `minExpected` hits are pooled, smallest first. `tolerance`: error allowed in the sum of the
// probabilities, for integrals by quadrature. Throws std::invalid_argument if sizes differ, a
// probability is negative or not finite, the counts exceed the samples, or fewer than two cells are
// left after pooling (nothing to test).
Chi2Result chi2Test(std::span<const uint64_t> counts, std::span<const double> probabilities,
                    uint64_t samples, double minExpected = 5.0, double tolerance = 1e-3);

}  // namespace restlab::stats
