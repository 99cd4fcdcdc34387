// Error and energy of single frames against a reference in halves, over a window of frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/image.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

class RunningError {
 public:
  // Discards all frames: numbers of two settings must not be mixed.
  void restart();
  // Adds a frame, compared with the current reference: its mean, independent halves, and samples
  // per pixel. relMSE and energy divide by the mean and would mix references of different noise:
  // they restart whenever `referenceSpp` has doubled.
  void add(const Image& frame, const Image& mean, const Image& half0, const Image& half1,
           uint64_t referenceSpp);

  size_t frames() const { return mse_.size(); }
  double lastMse() const { return mse_.last(); }  // requires a frame
  // Means over the window; constant time for any length. Intervals come from kBatches consecutive
  // batches of frames and are NaN before kLeastFrames. Histories longer than a batch make them too
  // narrow, a method that still converges makes them wide.
  Interval mse() const;
  Interval relmse() const;       // relmse_e1e-2 against the halves
  Interval energyRatio() const;  // mean(frame) / mean(reference)
  // Means of the newest kNewest frames, in which a converged method no longer warms up; NaN before
  // there are kNewest frames.
  double newestMse() const { return mse_.meanOfNewest(); }
  double newestRelmse() const { return relmse_.meanOfNewest(); }

  static constexpr size_t kBatches = 8, kLeastFrames = 64, kNewest = 32;

 private:
  // Numbers and their prefix sums.
  class Window {
   public:
    void add(double number);
    void clear();
    size_t size() const { return numbers_.size(); }
    double last() const { return numbers_.back(); }
    Interval mean() const;
    double meanOfNewest() const;

   private:
    double meanOf(size_t first, size_t last) const {
      return (sums_[last] - sums_[first]) / double(last - first);
    }

    std::vector<double> numbers_, sums_{0.0};
  };
  Window mse_, relmse_, energy_;
  uint64_t relativeSpp_ = 0;  // reference's spp when relmse_ and energy_ began
};

}  // namespace restlab
