#include "experiments/statistics/bias_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "experiments/statistics/halves_noise.h"

namespace restlab {

void BiasRuns::add(const Image& run) {
  if (!groups_.empty()) {
    const Image& first = groups_.front().sum;
    if (run.width != first.width || run.height != first.height) {
      failInput(fmt::format("a run is {}x{}, those before it {}x{}", run.width, run.height,
                            first.width, first.height));
    }
  }
  if (groups_.empty()) first_ = run;
  const double squares = mseAgainstHalves(run, first_, first_);
  const size_t g = count_++ % kGroups;
  if (g == groups_.size()) {
    groups_.push_back({run, 1, squares});
    return;
  }
  Group& group = groups_[g];
  group.squares += squares;
  for (size_t p = 0; p < run.pixels.size(); ++p) group.sum.pixels[p] += run.pixels[p];
  ++group.count;
}

std::vector<Image> BiasRuns::means() const {
  std::vector<Image> all;
  for (const Group& group : groups_) {
    Image& mean = all.emplace_back(group.sum);
    for (glm::vec3& pixel : mean.pixels) pixel /= float(group.count);
  }
  return all;
}

Interval BiasRuns::variance() const {
  const size_t n = groups_.size();
  if (n < 2) return {kNan, kNan, kNan};
  // Use differences from the first run: subtracting large squares would lose precision.
  const std::vector<Image> mean = means();
  std::vector<double> product(n * n);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      product[i * n + j] = product[j * n + i] =
          restlab::squaredBias(mean[i], mean[j], first_, first_);
    }
  }
  const auto sampleVariance = [&](std::span<const size_t> chosen) {
    double runs = 0.0, squares = 0.0, squareOfSum = 0.0;
    for (const size_t i : chosen) {
      runs += double(groups_[i].count);
      squares += groups_[i].squares;
      for (const size_t j : chosen)
        squareOfSum += double(groups_[i].count) * double(groups_[j].count) * product[i * n + j];
    }
    return (squares - squareOfSum / runs) / (runs - 1.0);
  };
  return jackknifeInterval(n, sampleVariance);
}

Interval BiasRuns::squaredBias(const Image& half0, const Image& half1,
                               const PixelMask& mask) const {
  const size_t n = groups_.size();
  if (n < 2) return {kNan, kNan, kNan};
  const std::vector<Image> mean = means();
  std::vector<double> product(n * n, 0.0);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) {
      if (i != j) product[i * n + j] = restlab::squaredBias(mean[i], mean[j], half0, half1, mask);
    }
  }
  // Weight a pair of groups by its number of pairs of runs.
  const auto meanOfPairs = [&](std::span<const size_t> chosen) {
    double sum = 0.0, pairs = 0.0;
    for (const size_t i : chosen) {
      for (const size_t j : chosen) {
        if (i == j) continue;
        const double weight = double(groups_[i].count) * double(groups_[j].count);
        sum += weight * product[i * n + j];
        pairs += weight;
      }
    }
    return sum / pairs;
  };
  return widened(jackknifeInterval(n, meanOfPairs), sharedVariance(half0, half1, mask));
}

double BiasRuns::sharedVariance(const Image& half0, const Image& half1,
                                const PixelMask& mask) const {
  const double ofAnyMethod = halvesNoise(half0, half1, mask).varianceOfProduct;
  if (groups_.size() < 2) return ofAnyMethod;
  return std::max(ofAnyMethod, restlab::sharedVariance(means(), half0, half1, mask));
}

MetricValue BiasRuns::biasRms(const Image& half0, const Image& half1, const PixelMask& mask) const {
  const Interval squared = squaredBias(half0, half1, mask);
  if (std::isnan(squared.value)) {
    size_t inRuns = 0;
    for (const Image& mean : means()) inRuns += countNonfinite(mean, mask);
    return {kNan, fmt::format("{} non-finite values in the runs, {} in the reference", inRuns,
                              countNonfinite(half0, mask) + countNonfinite(half1, mask))};
  }
  std::string detail = fmt::format("squared bias {:+.6g}", squared.value);
  if (!std::isnan(squared.lo)) detail += fmt::format(" [{:+.3g}, {:+.3g}]", squared.lo, squared.hi);
  return {std::sqrt(std::max(0.0, squared.value)), detail};
}

}  // namespace restlab
