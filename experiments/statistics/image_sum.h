// Sums of frames in double precision, in a fixed order: the mean does not depend on threads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// Sum of equally sized frames, or of their squares.
class ImageSum {
 public:
  ImageSum() = default;
  // Restores a sum of `count` frames (at least one) of that size.
  ImageSum(uint32_t width, uint32_t height, uint64_t count, std::vector<glm::dvec3> sums);

  void add(const Image& frame);
  void addSquares(const Image& frame);
  // Adds another sum of such frames.
  void add(const ImageSum& sum);
  uint64_t count() const { return count_; }
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  // Row by row, row 0 on top; empty before the first frame.
  const std::vector<glm::dvec3>& sums() const { return sum_; }

  // Mean of the frames; at least one frame must have been added.
  Image mean() const;

 private:
  void begin(const Image& frame);
  uint32_t width_ = 0, height_ = 0;
  uint64_t count_ = 0;
  std::vector<glm::dvec3> sum_;
};

// Accumulated image of a still view after each frame. Up to the age `averagedFrames`, frames of a
// method average their whole history; a mean of such frames would count the first samples several
// times. Up to that age the accumulated image is therefore the last frame, and afterwards the mean
// of the frames since: all frames of the history but the last ones have the same weight.
class HistoryMean {
 public:
  explicit HistoryMean(double averagedFrames) : averagedFrames_(averagedFrames) {}
  // Adds the next frame of the history.
  void add(const Image& frame);
  uint64_t frames() const { return frames_; }
  Image mean() const { return sum_.mean(); }

 private:
  double averagedFrames_;
  uint64_t frames_ = 0;
  ImageSum sum_;
};

}  // namespace restlab
