#include "experiments/statistics/image_sum.h"

#include <utility>

namespace restlab {

ImageSum::ImageSum(uint32_t width, uint32_t height, uint64_t count, std::vector<glm::dvec3> sums)
    : width_(width), height_(height), count_(count), sum_(std::move(sums)) {}

void ImageSum::begin(const Image& frame) {
  if (count_ == 0) {
    width_ = frame.width;
    height_ = frame.height;
    sum_.assign(frame.pixels.size(), glm::dvec3(0.0));
  }
  ++count_;
}

void ImageSum::add(const Image& frame) {
  begin(frame);
  for (size_t i = 0; i < sum_.size(); ++i) sum_[i] += glm::dvec3(frame.pixels[i]);
}

void ImageSum::addSquares(const Image& frame) {
  begin(frame);
  for (size_t i = 0; i < sum_.size(); ++i) {
    const glm::dvec3 value(frame.pixels[i]);
    sum_[i] += value * value;
  }
}

Image ImageSum::mean() const {
  Image image(width_, height_);
  const double scale = 1.0 / double(count_);
  for (size_t i = 0; i < sum_.size(); ++i) image.pixels[i] = glm::vec3(sum_[i] * scale);
  return image;
}

Image ImageSum::meanOfBoth(const ImageSum& a, const ImageSum& b) {
  if (b.count_ == 0) return a.mean();
  Image image(a.width_, a.height_);
  const double scale = 1.0 / double(a.count_ + b.count_);
  for (size_t i = 0; i < a.sum_.size(); ++i) {
    image.pixels[i] = glm::vec3((a.sum_[i] + b.sum_[i]) * scale);
  }
  return image;
}

Image ImageSum::varianceOfMean(const ImageSum& a, const ImageSum& b, const ImageSum& squares) {
  Image image(a.width_, a.height_);
  const double n = double(a.count_ + b.count_);
  for (size_t i = 0; i < a.sum_.size(); ++i) {
    const glm::dvec3 mean = (a.sum_[i] + b.sum_[i]) / n;
    const glm::dvec3 meanSquare = squares.sum_[i] / n;
    // Clamp: rounding can make the variance of a constant pixel slightly negative.
    const glm::dvec3 variance = glm::max(meanSquare - mean * mean, glm::dvec3(0.0));
    image.pixels[i] = glm::vec3(variance / (n - 1.0));
  }
  return image;
}

void HistoryMean::add(const Image& frame) {
  ++frames_;
  if (double(frames_) <= averagedFrames_) sum_ = ImageSum();
  sum_.add(frame);
}

}  // namespace restlab
