// Error and energy of single frames against a reference in halves, over a window of frames.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image/image.h"
#include "core/image/intervals.h"

namespace restlab {

class RunningError {
 public:
  // Forgets every frame: numbers of two settings never mix.
  void restart();
  // A frame, and the reference as it is by then: its mean and independent halves.
  void add(const Image& frame, const Image& mean, const Image& half0, const Image& half1);

  size_t frames() const { return mse_.size(); }
  double lastMse() const { return mse_.back(); }  // there is a frame
  // Means over the window. Frames that share a history are correlated: intervals are those of
  // kBatches batches of frames side by side, and unknown before there are kLeastFrames.
  Interval mse() const;
  Interval relmse() const;       // relmse_e1e-2 against the halves
  Interval energyRatio() const;  // mean(frame) / mean(reference)

  static constexpr size_t kBatches = 8, kLeastFrames = 64;

 private:
  std::vector<double> mse_, relmse_, energy_;
};

}  // namespace restlab
