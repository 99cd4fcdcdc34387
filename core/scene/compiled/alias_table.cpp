#include "core/scene/compiled/alias_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace restlab {
namespace {

constexpr double kDraws = 4294967296.0;  // 2^32

// Fraction of the 32-bit values that rlMulHigh(bits, n) maps to i.
double shareOfCell(uint64_t i, uint64_t n) {
  const auto first = [n](uint64_t cell) { return ((cell << 32u) + n - 1u) / n; };
  return double(first(i + 1u) - first(i)) / kDraws;
}

// Converts a probability to a 32-bit threshold. The result is never 0 or 1: both outcomes stay
// possible.
uint32_t threshold(double probability) {
  return static_cast<uint32_t>(std::clamp(std::round(probability * kDraws), 1.0, kDraws - 1.0));
}

}  // namespace

std::vector<rl::AliasEntry> buildAliasTable(const std::vector<double>& weights, size_t width) {
  const size_t n = weights.size();
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<rl::AliasEntry> table(n);
  std::vector<double> scaled(n);
  std::vector<uint32_t> small, large;
  for (size_t i = 0; i < n; ++i) {
    scaled[i] = weights[i] / total * double(n);
    (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const uint32_t s = small.back(), l = large.back();
    small.pop_back();
    table[s].keep = weights[s] > 0.0 ? threshold(scaled[s]) : 0u;
    table[s].other = l;
    scaled[l] -= 1.0 - scaled[s];
    if (scaled[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // Remaining entries have probability 1 up to rounding, except an entry of weight 0: never keep
  // that one.
  const auto heaviest =
      static_cast<uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (const std::vector<uint32_t>& rest : {small, large}) {
    for (uint32_t i : rest) {
      table[i].keep = weights[i] > 0.0 ? threshold(1.0) : 0u;
      table[i].other = weights[i] > 0.0 ? i : heaviest;
    }
  }
  std::vector<double> pmf(n, 0.0);
  for (size_t i = 0; i < n; ++i) {
    const double cell = shareOfCell(i % width, width) * shareOfCell(i / width, n / width);
    const double kept = cell * (double(table[i].keep) / kDraws);
    pmf[i] += kept;
    pmf[table[i].other] += cell - kept;
  }
  for (size_t i = 0; i < n; ++i) table[i].pmf = static_cast<float>(pmf[i]);
  return table;
}

}  // namespace restlab
