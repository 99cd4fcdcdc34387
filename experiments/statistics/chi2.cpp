#include "experiments/statistics/chi2.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace restlab::stats {
namespace {

struct Cell {
  double expected = 0.0, observed = 0.0;
};

// Joins the cells of smallest expectation until every cell expects at least `minExpected`.
std::vector<Cell> pool(std::vector<Cell> cells, double minExpected) {
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
  std::vector<Cell> result;
  Cell rest;
  bool pooling = false;  // a pool that expects no hits may still have some
  for (const Cell& cell : cells) {
    if (cell.expected < minExpected || (pooling && rest.expected < minExpected)) {
      pooling = true;
      rest.expected += cell.expected;
      rest.observed += cell.observed;
    } else {
      result.push_back(cell);
    }
  }
  if (pooling) result.push_back(rest);
  return result;
}

}  // namespace

Chi2Result chi2Test(std::span<const uint64_t> counts, std::span<const double> probabilities,
                    uint64_t samples, double minExpected, double tolerance) {
  if (counts.size() != probabilities.size()) {
    throw std::invalid_argument(fmt::format("chi2Test: {} counts but {} probabilities",
                                            counts.size(), probabilities.size()));
  }
  Chi2Result result;
  std::vector<Cell> cells;
  double total = 0.0;
  uint64_t hits = 0;
  size_t impossibleCell = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    const double p = probabilities[i];
    if (!(p >= 0.0) || !std::isfinite(p)) {
      throw std::invalid_argument(fmt::format("chi2Test: probability {} of cell {}", p, i));
    }
    total += p;
    hits += counts[i];
    if (p == 0.0) {
      if (counts[i] > 0 && !result.impossible) {
        result.impossible = true;
        impossibleCell = i;
      }
    } else {
      cells.push_back({p * double(samples), double(counts[i])});
    }
  }
  if (hits > samples) {
    throw std::invalid_argument(fmt::format("chi2Test: {} hits of {} samples", hits, samples));
  }
  result.failures = samples - hits;
  result.excess = total > 1.0 + tolerance;
  if (result.impossible || result.excess) {
    result.summary = result.impossible
                         ? fmt::format("chi2: {} hits in cell {}, whose probability is 0",
                                       counts[impossibleCell], impossibleCell)
                         : fmt::format("chi2: probabilities sum to {:.6f}", total);
    return result;
  }
  // Clamp: within the tolerance the rest may be slightly negative. Failures beyond the remaining
  // probability count in the pooled cell.
  const double rest = std::max(0.0, 1.0 - total) * double(samples);
  if (rest > 0.0 || result.failures > 0) cells.push_back({rest, double(result.failures)});
  cells = pool(std::move(cells), minExpected);
  if (cells.size() < 2) {
    throw std::invalid_argument("chi2Test: fewer than two cells after pooling, nothing to test");
  }
  for (const Cell& cell : cells) {
    const double d = cell.observed - cell.expected;
    result.statistic += d * d / cell.expected;
  }
  result.dof = double(cells.size() - 1);
  result.pValue = boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(result.dof), result.statistic));
  result.summary = fmt::format(
      "chi2: statistic {:.3f}, {} degrees of freedom, p {:.3g}, {} of {} "
      "samples in no cell",
      result.statistic, result.dof, result.pValue, result.failures, samples);
  return result;
}

}  // namespace restlab::stats
