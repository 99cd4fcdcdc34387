// Error and energy of single frames against a reference in halves, over a window of frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/image.h"
#include "core/image/intervals.h"

namespace restlab {

class RunningError {
 public:
  // Forgets every frame: numbers of two settings never mix.
  void restart();
  // A frame, and the reference as it is by then: its mean, independent halves, and the samples of
  // a pixel that are in them. relMSE and energy divide by the mean: those of a reference that was
  // still noisy are another number. They begin anew whenever the samples have doubled.
  void add(const Image& frame, const Image& mean, const Image& half0, const Image& half1,
           uint64_t referenceSpp);

  size_t frames() const { return mse_.size(); }
  double lastMse() const { return mse_.last(); }  // there is a frame
  // Means over the window; each costs the same however long it is. Intervals are those of kBatches
  // batches of frames side by side, and unknown before there are kLeastFrames. Histories that are
  // longer than a batch make them too narrow, and a method that still converges makes them wide.
  Interval mse() const;
  Interval relmse() const;       // relmse_e1e-2 against the halves
  Interval energyRatio() const;  // mean(frame) / mean(reference)
  // Means of the newest kNewest frames, which a method that has converged by then no longer warms
  // up in; NaN before there are so many.
  double newestMse() const { return mse_.meanOfNewest(); }
  double newestRelmse() const { return relmse_.meanOfNewest(); }

  static constexpr size_t kBatches = 8, kLeastFrames = 64, kNewest = 32;

 private:
  // Numbers, and their sums from the first on.
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
  uint64_t relativeSpp_ = 0;  // of the reference when relmse_ and energy_ began
};

}  // namespace restlab
