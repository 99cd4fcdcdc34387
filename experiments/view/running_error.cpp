#include "experiments/view/running_error.h"

#include <limits>
#include <numeric>

#include "core/image/metrics/metrics.h"

namespace restlab {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double meanOf(const Image& image) {
  const glm::dvec3 means = channelMeans(image);
  return (means.x + means.y + means.z) / 3.0;
}

}  // namespace

void RunningError::Window::add(double number) {
  numbers_.push_back(number);
  sums_.push_back(sums_.back() + number);
}

void RunningError::Window::clear() {
  numbers_.clear();
  sums_.assign(1, 0.0);
}

Interval RunningError::Window::mean() const {
  const size_t count = size();
  if (count == 0) return {kUnknown, kUnknown, kUnknown};
  const double mean = meanOf(0, count);
  if (count < kLeastFrames) return {mean, kUnknown, kUnknown};
  std::vector<double> batches;
  for (size_t b = 0; b < kBatches; ++b)
    batches.push_back(meanOf(b * count / kBatches, (b + 1) * count / kBatches));
  Interval interval = meanInterval(batches);
  // Batches may differ in size by one frame: move the interval to the exact mean.
  interval.lo += mean - interval.value;
  interval.hi += mean - interval.value;
  interval.value = mean;
  return interval;
}

// Sums directly, not by differences of sums_: a non-finite frame must not affect later windows.
double RunningError::Window::meanOfNewest() const {
  if (size() < kNewest) return kUnknown;
  return std::accumulate(numbers_.end() - std::ptrdiff_t(kNewest), numbers_.end(), 0.0) /
         double(kNewest);
}

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
  mse_.add(mseAgainstHalves(frame, half0, half1));
  relmse_.add(relmseAgainstHalves(frame, mean, half0, half1).relmse);
  energy_.add(meanOf(frame) / meanOf(mean));
}

Interval RunningError::mse() const { return mse_.mean(); }
Interval RunningError::relmse() const { return relmse_.mean(); }
Interval RunningError::energyRatio() const { return energy_.mean(); }

}  // namespace restlab
