#include "experiments/statistics/block_sum.h"

#include <utility>

namespace restlab {

BlockSum::BlockSum(uint64_t framesOfBlock, ImageSum blocks, ImageSum open)
    : framesOfBlock_(framesOfBlock), blocks_(std::move(blocks)), open_(std::move(open)) {}

void BlockSum::add(const Image& frame) {
  open_.add(frame);
  closeFull();
}

void BlockSum::addSquares(const Image& frame) {
  open_.addSquares(frame);
  closeFull();
}

void BlockSum::addBlock(ImageSum block) {
  open_ = std::move(block);
  closeFull();
}

void BlockSum::closeFull() {
  if (open_.count() < framesOfBlock_) return;
  if (blocks_.count() == 0) {
    blocks_ = std::move(open_);
  } else {
    blocks_.add(open_);
  }
  open_ = ImageSum();
}

size_t BlockSum::bytesPerPixel() const {
  return (size_t(blocks_.count() > 0) + size_t(open_.count() > 0)) * sizeof(glm::dvec3);
}

glm::dvec3 BlockSum::at(size_t pixel) const {
  if (open_.count() == 0) return blocks_.sums()[pixel];
  if (blocks_.count() == 0) return open_.sums()[pixel];
  return blocks_.sums()[pixel] + open_.sums()[pixel];
}

Image BlockSum::mean() const {
  Image image(width(), height());
  const double scale = 1.0 / double(count());
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = glm::vec3(at(i) * scale);
  return image;
}

Image BlockSum::meanOfBoth(const BlockSum& a, const BlockSum& b) {
  if (b.count() == 0) return a.mean();
  Image image(a.width(), a.height());
  const double scale = 1.0 / double(a.count() + b.count());
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = glm::vec3((a.at(i) + b.at(i)) * scale);
  return image;
}

Image BlockSum::varianceOfMean(const BlockSum& a, const BlockSum& b, const BlockSum& squares) {
  Image image(a.width(), a.height());
  const double n = double(a.count() + b.count());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const glm::dvec3 mean = (a.at(i) + b.at(i)) / n;
    const glm::dvec3 meanSquare = squares.at(i) / n;
    // Clamp: rounding can make the variance of a constant pixel slightly negative.
    const glm::dvec3 variance = glm::max(meanSquare - mean * mean, glm::dvec3(0.0));
    image.pixels[i] = glm::vec3(variance / (n - 1.0));
  }
  return image;
}

}  // namespace restlab
