// Independent runs of one method, reduced to block means as they arrive: enough for a bias test, in
// a few kilobytes at any resolution.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image/image.h"
#include "experiments/statistics/welch.h"

namespace restlab::stats {

// Quantities that are compared.
enum class Quantity : uint32_t { luminance = 0, red = 1, green = 2, blue = 3 };
constexpr size_t kQuantities = 4;
const char* quantityName(Quantity quantity);

// Returns a quantity of one pixel, linear Rec. 709.
double quantityOf(const glm::vec3& pixel, Quantity quantity);

// A square grid of blocks over an image: at most 8x8 = 64, fewer for an image below 8 pixels a
// side.
struct BlockGrid {
  uint32_t width = 0, height = 0;  // of the image, pixels
  uint32_t side = 0;               // blocks per side: 8, 4, 2 or 1

  BlockGrid() = default;
  // Throws std::invalid_argument for an image without pixels or maxSide not a power of two.
  BlockGrid(uint32_t width, uint32_t height, uint32_t maxSide = 8);
  uint32_t columnBegin(uint32_t x) const { return uint32_t(uint64_t(x) * width / side); }
  uint32_t rowBegin(uint32_t y) const { return uint32_t(uint64_t(y) * height / side); }
  size_t count() const { return size_t(side) * side; }
};

// Square of blocks: [x, x + size) x [y, y + size) in units of blocks.
struct CellArea {
  uint32_t x = 0, y = 0, size = 1;
};
uint64_t pixelCount(const BlockGrid& grid, const CellArea& area);

class RunSet {
 public:
  explicit RunSet(const BlockGrid& grid) : grid_(grid) {}

  // Adds one independent run: a new seed and a new history. Throws std::invalid_argument if the
  // size is not the grid's.
  void add(const Image& run);

  size_t runs() const { return sums_.size(); }
  const BlockGrid& grid() const { return grid_; }
  uint64_t nonfinite() const {
    return nonfinite_;
  }  // channel values seen, which invalidate every verdict

  // Returns the mean over the cell's pixels, one value per run.
  std::vector<double> cellMeans(const CellArea& area, Quantity quantity) const;

 private:
  using BlockSums = std::vector<std::array<double, kQuantities>>;
  BlockGrid grid_;
  std::vector<BlockSums> sums_;  // [run][block]
  uint64_t nonfinite_ = 0;
};

// Returns Fisher's skewness m3 / m2^1.5 of a sample; 0 if it is constant up to rounding.
double skewness(const std::vector<double>& values);

// Reference of each cell: a mean and its uncertainty. Assumes independent pixels, which holds for a
// path tracer with a box filter.
class ReferenceCells {
 public:
  // From two independent halves of equal size: their mean, and the variance from their difference.
  static ReferenceCells fromHalves(const BlockGrid& grid, const Image& half0, const Image& half1);
  // From a mean and, per pixel, the variance of that mean (not of one sample).
  static ReferenceCells fromVariance(const BlockGrid& grid, const Image& mean,
                                     const Image& varianceOfMean);
  // From an analytic truth without error.
  static ReferenceCells exact(const BlockGrid& grid, const Image& truth);

  const BlockGrid& grid() const { return grid_; }
  uint64_t nonfinite() const { return nonfinite_; }
  Sample cell(const CellArea& area, Quantity quantity) const;

 private:
  struct Block {
    std::array<double, kQuantities> sum{};
    std::array<double, kQuantities> variance{};         // of the sum
    std::array<double, kQuantities> varianceSquared{};  // sum of squares of pixel variances
  };
  ReferenceCells(const BlockGrid& grid, double dofPerPixel);
  template <class F>
  static ReferenceCells build(const BlockGrid& grid, const Image& image, double dofPerPixel,
                              F valueAndVariance);

  BlockGrid grid_;
  double dofPerPixel_;  // of each pixel's variance estimate; infinite if the variance is known
  std::vector<Block> blocks_;
  uint64_t nonfinite_ = 0;
};

}  // namespace restlab::stats
