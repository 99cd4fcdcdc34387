// Squared bias of a method from independent runs of it, over all pairs of runs.
//
// With d_i = run_i - half0 and e_j = run_j - half1, the product d_i e_j of two different runs has
// the squared bias as its mean: the runs' noise and the halves' noise are independent. The estimate
// is the mean over all ordered pairs i != j, a U-statistic (Hoeffding 1948): the smallest variance
// that an unbiased estimate of these runs has. It is signed: about 0, of either sign, for an
// unbiased method.
#pragma once

#include <vector>

#include "core/image/image.h"
#include "core/image/intervals.h"
#include "core/image/metrics.h"

namespace restlab {

class BiasRuns {
 public:
  // Images that are kept: with more runs than that each is the mean of several, and pairs are of
  // different groups.
  static constexpr size_t kGroups = 8;

  // Throws Error (badInput) where it has another size than those before.
  void add(const Image& run);
  size_t count() const { return count_; }

  // With a 95 % interval: the jackknife's over groups, widened by the noise of the halves, which
  // all pairs share. The value is NaN with fewer than two runs or with values that are not finite,
  // the ends with fewer than three. Throws Error (badInput) on different sizes.
  Interval squaredBias(const Image& half0, const Image& half1, const PixelMask& mask = {}) const;
  // The other part of the MSE: the mean over pixels of the sample variance over all runs, without
  // the reference. With up to kGroups runs it is exactly their mean MSE less squaredBias(). The
  // interval is the jackknife's over groups; what is unknown as there.
  Interval variance() const;
  // Variance of the noise of the halves that all runs share, in their squared bias and in the mean
  // of their MSE alike (core/image/halves_noise.h): of all pairs, and at least what any method has.
  double sharedVariance(const Image& half0, const Image& half1, const PixelMask& mask = {}) const;
  // The metric bias_rms: its root, or 0 where it is negative; the detail has the signed square, or
  // how many values are not finite.
  MetricValue biasRms(const Image& half0, const Image& half1, const PixelMask& mask = {}) const;

  // Of the groups: the runs themselves where there are no more than kGroups.
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
