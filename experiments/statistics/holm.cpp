#include "experiments/statistics/holm.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace restlab::stats {

std::vector<double> holmAdjusted(std::span<const double> pValues) {
  for (const double p : pValues) {
    if (!(p >= 0.0 && p <= 1.0)) throw std::invalid_argument("holmAdjusted: p not in [0, 1]");
  }
  std::vector<size_t> order(pValues.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return pValues[i] < pValues[j]; });
  std::vector<double> adjusted(pValues.size());
  double previous = 0.0;
  for (size_t rank = 0; rank < order.size(); ++rank) {
    const double scaled = double(order.size() - rank) * pValues[order[rank]];
    previous = std::min(1.0, std::max(previous, scaled));
    adjusted[order[rank]] = previous;
  }
  return adjusted;
}

std::vector<bool> holmReject(std::span<const double> pValues, double familyError) {
  const std::vector<double> adjusted = holmAdjusted(pValues);
  std::vector<bool> rejected(adjusted.size());
  for (size_t i = 0; i < adjusted.size(); ++i) rejected[i] = adjusted[i] <= familyError;
  return rejected;
}

}  // namespace restlab::stats
