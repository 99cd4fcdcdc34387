// Sums of frames in double precision, in a fixed order: the mean does not depend on threads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/image/image.h"
#include "core/session.h"

namespace restlab {

// Sum, and optionally sum of squares, of equally sized frames.
class ImageSum {
 public:
  explicit ImageSum(bool squares = false) : squares_(squares) {}
  void add(const Image& frame);
  uint64_t count() const { return count_; }
  // Mean of the frames; at least one frame must have been added.
  Image mean() const;
  // Mean of the frames of both sums.
  static Image meanOfBoth(const ImageSum& a, const ImageSum& b);
  // Per-pixel variance of that mean, from the sample variance over all frames (at least two).
  static Image varianceOfMean(const ImageSum& a, const ImageSum& b);

 private:
  bool squares_;
  uint32_t width_ = 0, height_ = 0;
  uint64_t count_ = 0;
  std::vector<glm::dvec3> sum_, sumSquares_;
};

// Counters of several frames.
struct HealthSum {
  Health health;
  uint64_t raysPath = 0, raysShadow = 0;
  void add(const FrameStats& frame);
  // "nonfinite=0 rejected_jacobian=12 ...".
  std::string text() const;
};

}  // namespace restlab
