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

void ImageSum::add(const ImageSum& sum) {
  if (count_ == 0) {
    *this = sum;
    return;
  }
  count_ += sum.count_;
  for (size_t i = 0; i < sum_.size(); ++i) sum_[i] += sum.sum_[i];
}

Image ImageSum::mean() const {
  Image image(width_, height_);
  const double scale = 1.0 / double(count_);
  for (size_t i = 0; i < sum_.size(); ++i) image.pixels[i] = glm::vec3(sum_[i] * scale);
  return image;
}

void HistoryMean::add(const Image& frame) {
  ++frames_;
  if (double(frames_) <= averagedFrames_) sum_ = ImageSum();
  sum_.add(frame);
}

}  // namespace restlab
