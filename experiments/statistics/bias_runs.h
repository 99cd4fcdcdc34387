// Squared bias of a method from independent runs of it, over all pairs of runs.
//
// With d_i = run_i - half0 and e_j = run_j - half1, the product d_i e_j of two different runs has
// the squared bias as its mean: the runs' noise and the halves' noise are independent. The estimate
// is the mean over all ordered pairs i != j, a U-statistic (Hoeffding 1948): the smallest variance
// that an unbiased estimate of these runs has. The estimate is signed: about 0, of either sign, for
// an unbiased method.
#pragma once

#include <vector>

#include "core/image/image.h"
#include "core/image/metrics/metrics.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

class BiasRuns {
 public:
  // Number of images kept. With more runs, each image is the mean of several runs, and pairs are
  // formed between groups.
  static constexpr size_t kGroups = 8;

  // Throws Error (badInput) if the size differs from earlier runs.
  void add(const Image& run);
  size_t count() const { return count_; }

  // Squared bias with a 95 % interval: the jackknife's over groups, widened by the noise of the
  // halves, which all pairs share. The value is NaN with fewer than two runs or with non-finite
  // values, the ends are NaN with fewer than three runs. Throws Error (badInput) on different
  // sizes.
  Interval squaredBias(const Image& half0, const Image& half1, const PixelMask& mask = {}) const;
  // The other part of the MSE: the mean over pixels of the sample variance over all runs, without
  // the reference. With up to kGroups runs it is exactly their mean MSE minus squaredBias(). The
  // interval is the jackknife's over groups; value and ends are NaN as in squaredBias().
  Interval variance() const;
  // Variance due to the noise of the halves that all runs share, in their squared bias and in their
  // mean MSE alike (experiments/statistics/halves_noise.h): the estimate from all pairs, but at
  // least the part common to all methods.
  double sharedVariance(const Image& half0, const Image& half1, const PixelMask& mask = {}) const;
  // The metric bias_rms: root of the squared bias, or 0 if that is negative. The detail has the
  // signed square, or the number of non-finite values.
  MetricValue biasRms(const Image& half0, const Image& half1, const PixelMask& mask = {}) const;

  // Means of the groups: the runs themselves if there are at most kGroups.
  std::vector<Image> means() const;

 private:
  struct Group {
    Image sum;
    size_t count = 0;
    double squares = 0.0;  // sum over its runs of mean (run - first)^2
  };
  std::vector<Group> groups_;
  Image first_;
  size_t count_ = 0;
};

}  // namespace restlab
