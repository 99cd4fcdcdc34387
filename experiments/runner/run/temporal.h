// Temporal figures of the frames of a run: flicker and the correlation of their errors.
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Compares the measured frame with the one before it, and their references, for a moving camera.
TemporalFigures figuresOfPair(const Image& before, const Image& measured,
                              const Reference& referenceBefore, const Reference& reference);

// Accumulates the figures of successive frames of one size against one reference (a still camera).
class TemporalSum {
 public:
  static constexpr size_t kLags = std::tuple_size_v<decltype(TemporalFigures::autocorrelation)>;

  // `reference` must outlive this.
  explicit TemporalSum(const Reference& reference) : reference_(reference) {}
  void add(const Image& frame);
  // Requires at least one frame; figures that need two are NaN if there is only one.
  TemporalFigures figures() const;

 private:
  const Reference& reference_;
  std::deque<Image> last_;  // newest first
  std::vector<glm::dvec3> sum_, sumSquares_;
  size_t frames_ = 0;
  double differences_ = 0.0, squaredDifferences_ = 0.0;
  std::array<double, kLags + 1> products_{};  // of errors k frames apart, mean over pixels
};

}  // namespace restlab
