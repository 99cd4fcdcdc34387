#include "experiments/view/running_error.h"

#include <limits>
#include <numeric>

#include "core/image/metrics.h"

namespace restlab {

namespace {

double meanOf(const std::vector<double>& numbers, size_t first, size_t last) {
  const auto begin = numbers.begin() + std::ptrdiff_t(first);
  const auto end = numbers.begin() + std::ptrdiff_t(last);
  return std::accumulate(begin, end, 0.0) / double(last - first);
}

Interval intervalOf(const std::vector<double>& numbers) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (numbers.empty()) return {kUnknown, kUnknown, kUnknown};
  const size_t count = numbers.size();
  const double mean = meanOf(numbers, 0, count);
  if (count < RunningError::kLeastFrames) return {mean, kUnknown, kUnknown};
  std::vector<double> batches;
  for (size_t b = 0; b < RunningError::kBatches; ++b) {
    batches.push_back(meanOf(numbers, b * count / RunningError::kBatches,
                             (b + 1) * count / RunningError::kBatches));
  }
  Interval interval = meanInterval(batches);
  // Batches may differ by a frame.
  interval.lo += mean - interval.value;
  interval.hi += mean - interval.value;
  interval.value = mean;
  return interval;
}

double meanOf(const Image& image) {
  const glm::dvec3 means = channelMeans(image);
  return (means.x + means.y + means.z) / 3.0;
}

}  // namespace

void RunningError::restart() {
  mse_.clear();
  relmse_.clear();
  energy_.clear();
  relativeSpp_ = 0;
}

void RunningError::add(const Image& frame, const Image& mean, const Image& half0,
                       const Image& half1, uint64_t referenceSpp) {
  if (referenceSpp >= 2 * relativeSpp_) {
    relmse_.clear();
    energy_.clear();
    relativeSpp_ = referenceSpp;
  }
  mse_.push_back(mseAgainstHalves(frame, half0, half1));
  relmse_.push_back(relmseAgainstHalves(frame, mean, half0, half1).relmse);
  energy_.push_back(meanOf(frame) / meanOf(mean));
}

Interval RunningError::mse() const { return intervalOf(mse_); }
Interval RunningError::relmse() const { return intervalOf(relmse_); }
Interval RunningError::energyRatio() const { return intervalOf(energy_); }

}  // namespace restlab
