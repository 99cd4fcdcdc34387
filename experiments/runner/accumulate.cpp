#include "experiments/runner/accumulate.h"

#include <fmt/format.h>

namespace restlab {

void ImageSum::add(const Image& frame) {
  if (count_ == 0) {
    width_ = frame.width;
    height_ = frame.height;
    sum_.assign(frame.pixels.size(), glm::dvec3(0.0));
    if (squares_) sumSquares_.assign(frame.pixels.size(), glm::dvec3(0.0));
  }
  for (size_t i = 0; i < sum_.size(); ++i) {
    const glm::dvec3 value(frame.pixels[i]);
    sum_[i] += value;
    if (squares_) sumSquares_[i] += value * value;
  }
  ++count_;
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

Image ImageSum::varianceOfMean(const ImageSum& a, const ImageSum& b) {
  Image image(a.width_, a.height_);
  const double n = double(a.count_ + b.count_);
  for (size_t i = 0; i < a.sum_.size(); ++i) {
    const glm::dvec3 mean = (a.sum_[i] + b.sum_[i]) / n;
    const glm::dvec3 meanSquare = (a.sumSquares_[i] + b.sumSquares_[i]) / n;
    // Rounding can leave a variance of a constant pixel a hair below zero.
    const glm::dvec3 variance = glm::max(meanSquare - mean * mean, glm::dvec3(0.0));
    image.pixels[i] = glm::vec3(variance / (n - 1.0));
  }
  return image;
}

void HealthSum::add(const FrameStats& frame) {
  for (size_t i = 0; i < health.counts.size(); ++i) health.counts[i] += frame.health.counts[i];
  raysPath += frame.raysPath;
  raysShadow += frame.raysShadow;
}

std::string HealthSum::text() const {
  std::string text;
  for (size_t i = 0; i < health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (!name || !*name) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, health.counts[i]);
  }
  return text;
}

}  // namespace restlab
