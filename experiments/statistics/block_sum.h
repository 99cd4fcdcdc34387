// Sums of frames by blocks. Blocks that were summed elsewhere give the same bits, which sums of
// frames one by one would not.
#pragma once

#include "experiments/statistics/image_sum.h"

namespace restlab {

// Sum of equally sized frames, or of their squares: that of the complete blocks, added up in their
// order, and that of the block under way, from zero.
class BlockSum {
 public:
  // `framesOfBlock`: at least 1.
  explicit BlockSum(uint64_t framesOfBlock) : framesOfBlock_(framesOfBlock) {}
  // Restores a sum; `open` has fewer frames than a block.
  BlockSum(uint64_t framesOfBlock, ImageSum blocks, ImageSum open);

  void add(const Image& frame);
  void addSquares(const Image& frame);
  // Adds the next block, complete or as the last one. Requires that open() is empty.
  void addBlock(ImageSum block);

  uint64_t framesOfBlock() const { return framesOfBlock_; }
  uint64_t count() const { return blocks_.count() + open_.count(); }
  uint32_t width() const { return any().width(); }
  uint32_t height() const { return any().height(); }
  const ImageSum& blocks() const { return blocks_; }
  const ImageSum& open() const { return open_; }
  // Returns the sum of at most one block.
  const ImageSum& onlyBlock() const { return any(); }
  // Memory of the sums.
  size_t bytesPerPixel() const;

  // Mean of the frames; at least one frame must have been added.
  Image mean() const;
  // Mean of the frames of both sums.
  static Image meanOfBoth(const BlockSum& a, const BlockSum& b);
  // Per-pixel variance of that mean, from the sample variance over all frames (at least two).
  // `squares`: sum of the squares of all frames.
  static Image varianceOfMean(const BlockSum& a, const BlockSum& b, const BlockSum& squares);

 private:
  const ImageSum& any() const { return blocks_.count() > 0 ? blocks_ : open_; }
  glm::dvec3 at(size_t pixel) const;
  void closeFull();
  uint64_t framesOfBlock_;
  ImageSum blocks_, open_;
};

}  // namespace restlab
