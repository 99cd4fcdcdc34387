// Sums of frames in double precision, in a fixed order: the mean does not depend on threads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/image/image.h"
#include "core/session.h"

namespace restlab {

// Sum of equally sized frames, or of their squares.
class ImageSum {
 public:
  ImageSum() = default;
  // A sum as it was after `count` frames (at least one) of that size.
  ImageSum(uint32_t width, uint32_t height, uint64_t count, std::vector<glm::dvec3> sums);

  void add(const Image& frame);
  void addSquares(const Image& frame);
  uint64_t count() const { return count_; }
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  // Row by row, row 0 on top; empty before the first frame.
  const std::vector<glm::dvec3>& sums() const { return sum_; }

  // Mean of the frames; at least one frame must have been added.
  Image mean() const;
  // Mean of the frames of both sums.
  static Image meanOfBoth(const ImageSum& a, const ImageSum& b);
  // Per-pixel variance of that mean, from the sample variance over all frames (at least two);
  // `squares` is the sum of the squares of all of them.
  static Image varianceOfMean(const ImageSum& a, const ImageSum& b, const ImageSum& squares);

 private:
  void begin(const Image& frame);
  uint32_t width_ = 0, height_ = 0;
  uint64_t count_ = 0;
  std::vector<glm::dvec3> sum_;
};

// The accumulated image of a still view: what is best known of it after each frame. Frames of a
// method may be averages of its history already, of all of it up to `averagedFrames`; a mean of
// such frames from the first one on would count the first samples several times. So up to that age
// the last frame is the accumulated image, and from there on the mean of the frames since: all
// frames of the history but the last ones weigh the same in it.
class HistoryMean {
 public:
  explicit HistoryMean(double averagedFrames) : averagedFrames_(averagedFrames) {}
  // The next frame of the history.
  void add(const Image& frame);
  uint64_t frames() const { return frames_; }
  Image mean() const { return sum_.mean(); }

 private:
  double averagedFrames_;
  uint64_t frames_ = 0;
  ImageSum sum_;
};

// Whether the health count of that number must not happen: a value or a weight was lost. The others
// say what a method does.
bool isFault(size_t count);

// Counters of several frames.
struct HealthSum {
  Health health;
  uint64_t raysPath = 0, raysShadow = 0;
  void add(const FrameStats& frame);
  // "nonfinite=0 rejected_jacobian=12 ...".
  std::string text() const;
};

}  // namespace restlab
