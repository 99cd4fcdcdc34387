// Chi-squared verdicts of this program. Seeds are fixed, so a verdict never changes by itself; a
// correct sampler had to pass the family error only once.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiments/statistics/chi2.h"

namespace restlab::unit {

// Probability that any test of this program rejects a correct sampler, spread evenly (Bonferroni)
// over more tests than exist.
inline constexpr double kFamilyError = 1e-3;
inline constexpr double kTests = 500;

inline void expectFits(std::span<const uint64_t> counts, std::span<const double> probabilities,
                       uint64_t samples, const std::string& what) {
  const stats::Chi2Result result = stats::chi2Test(counts, probabilities, samples);
  EXPECT_GT(result.pValue, kFamilyError / kTests) << what << ": " << result.summary;
}

inline void expectUniform(std::span<const uint64_t> counts, const std::string& what) {
  uint64_t samples = 0;
  for (const uint64_t n : counts) samples += n;
  const std::vector<double> probabilities(counts.size(), 1.0 / double(counts.size()));
  expectFits(counts, probabilities, samples, what);
}

}  // namespace restlab::unit
