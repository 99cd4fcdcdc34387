#include "experiments/statistics/run_set.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/image/metrics/metrics.h"

namespace restlab::stats {
namespace {

// Calls f(block index, pixel) for all pixels, row by row.
template <class F>
void forEachPixel(const BlockGrid& grid, F f) {
  for (uint32_t by = 0; by < grid.side; ++by) {
    for (uint32_t y = grid.rowBegin(by); y < grid.rowBegin(by + 1); ++y) {
      for (uint32_t bx = 0; bx < grid.side; ++bx) {
        for (uint32_t x = grid.columnBegin(bx); x < grid.columnBegin(bx + 1); ++x) {
          f(size_t(by) * grid.side + bx, size_t(y) * grid.width + x);
        }
      }
    }
  }
}

template <class F>
void forEachBlock(const BlockGrid& grid, const CellArea& area, F f) {
  for (uint32_t y = area.y; y < area.y + area.size; ++y) {
    for (uint32_t x = area.x; x < area.x + area.size; ++x) f(size_t(y) * grid.side + x);
  }
}

void requireSize(const BlockGrid& grid, const Image& image) {
  if (image.width != grid.width || image.height != grid.height) {
    throw std::invalid_argument("bias test: an image has not the size of the grid");
  }
}

}  // namespace

const char* quantityName(Quantity quantity) {
  constexpr const char* kNames[kQuantities] = {"luminance", "red", "green", "blue"};
  return kNames[size_t(quantity)];
}

double quantityOf(const glm::vec3& pixel, Quantity quantity) {
  if (quantity == Quantity::luminance) {
    return 0.212639 * double(pixel.x) + 0.715169 * double(pixel.y) + 0.072192 * double(pixel.z);
  }
  return double(pixel[int(quantity) - 1]);
}

BlockGrid::BlockGrid(uint32_t imageWidth, uint32_t imageHeight, uint32_t maxSide)
    : width(imageWidth), height(imageHeight), side(maxSide) {
  if (width == 0 || height == 0) throw std::invalid_argument("BlockGrid: an image without pixels");
  if (maxSide == 0 || (maxSide & (maxSide - 1)) != 0) {
    throw std::invalid_argument("BlockGrid: the side must be a power of two");
  }
  while (side > width || side > height) side /= 2;
}

uint64_t pixelCount(const BlockGrid& grid, const CellArea& area) {
  return uint64_t(grid.columnBegin(area.x + area.size) - grid.columnBegin(area.x)) *
         (grid.rowBegin(area.y + area.size) - grid.rowBegin(area.y));
}

void RunSet::add(const Image& run) {
  requireSize(grid_, run);
  nonfinite_ += countNonfinite(run);
  BlockSums sums(grid_.count(), std::array<double, kQuantities>{});
  forEachPixel(grid_, [&](size_t block, size_t p) {
    for (size_t q = 0; q < kQuantities; ++q) {
      sums[block][q] += quantityOf(run.pixels[p], Quantity(q));
    }
  });
  sums_.push_back(std::move(sums));
}

std::vector<double> RunSet::cellMeans(const CellArea& area, Quantity quantity) const {
  const double pixels = double(pixelCount(grid_, area));
  std::vector<double> means;
  means.reserve(sums_.size());
  for (const BlockSums& sums : sums_) {
    double sum = 0.0;
    forEachBlock(grid_, area, [&](size_t block) { sum += sums[block][size_t(quantity)]; });
    means.push_back(sum / pixels);
  }
  return means;
}

double skewness(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double x : values) mean += x;
  mean /= double(values.size());
  double m2 = 0.0, m3 = 0.0;
  for (const double x : values) {
    m2 += (x - mean) * (x - mean);
    m3 += (x - mean) * (x - mean) * (x - mean);
  }
  m2 /= double(values.size());
  m3 /= double(values.size());
  // Return 0 if the spread is below the resolution of float images: its skewness is of rounding.
  const double rounding = 1e-7 * mean;
  return m2 > rounding * rounding ? m3 / (m2 * std::sqrt(m2)) : 0.0;
}

ReferenceCells::ReferenceCells(const BlockGrid& grid, double dofPerPixel)
    : grid_(grid), dofPerPixel_(dofPerPixel), blocks_(grid.count()) {}

template <class F>
ReferenceCells ReferenceCells::build(const BlockGrid& grid, const Image& image, double dofPerPixel,
                                     F valueAndVariance) {
  requireSize(grid, image);
  ReferenceCells cells(grid, dofPerPixel);
  cells.nonfinite_ = countNonfinite(image);
  forEachPixel(grid, [&](size_t block, size_t p) {
    for (size_t q = 0; q < kQuantities; ++q) {
      const auto [value, variance] = valueAndVariance(p, Quantity(q));
      cells.blocks_[block].sum[q] += value;
      cells.blocks_[block].variance[q] += variance;
      cells.blocks_[block].varianceSquared[q] += variance * variance;
    }
  });
  return cells;
}

ReferenceCells ReferenceCells::fromHalves(const BlockGrid& grid, const Image& half0,
                                          const Image& half1) {
  requireSize(grid, half1);
  ReferenceCells cells = build(grid, half0, 1.0, [&](size_t p, Quantity q) {
    const double a = quantityOf(half0.pixels[p], q);
    const double b = quantityOf(half1.pixels[p], q);
    // Unbiased estimate: Var((a + b) / 2) = E[(a - b)^2] / 4.
    return std::pair(0.5 * (a + b), 0.25 * (a - b) * (a - b));
  });
  cells.nonfinite_ += countNonfinite(half1);
  return cells;
}

ReferenceCells ReferenceCells::fromVariance(const BlockGrid& grid, const Image& mean,
                                            const Image& varianceOfMean) {
  requireSize(grid, varianceOfMean);
  const double infinite = std::numeric_limits<double>::infinity();
  ReferenceCells cells = build(grid, mean, infinite, [&](size_t p, Quantity q) {
    const glm::vec3& v = varianceOfMean.pixels[p];
    if (q != Quantity::luminance) return std::pair(quantityOf(mean.pixels[p], q), quantityOf(v, q));
    // The channels' correlation is not stored: assume full correlation, the largest variance.
    const double deviation = 0.212639 * std::sqrt(double(v.x)) + 0.715169 * std::sqrt(double(v.y)) +
                             0.072192 * std::sqrt(double(v.z));
    return std::pair(quantityOf(mean.pixels[p], q), deviation * deviation);
  });
  cells.nonfinite_ += countNonfinite(varianceOfMean);
  return cells;
}

ReferenceCells ReferenceCells::exact(const BlockGrid& grid, const Image& truth) {
  return build(grid, truth, std::numeric_limits<double>::infinity(), [&](size_t p, Quantity q) {
    return std::pair(quantityOf(truth.pixels[p], q), 0.0);
  });
}

Sample ReferenceCells::cell(const CellArea& area, Quantity quantity) const {
  const size_t q = size_t(quantity);
  double sum = 0.0, variance = 0.0, squared = 0.0;
  forEachBlock(grid_, area, [&](size_t block) {
    sum += blocks_[block].sum[q];
    variance += blocks_[block].variance[q];
    squared += blocks_[block].varianceSquared[q];
  });
  const double pixels = double(pixelCount(grid_, area));
  Sample s{1.0, sum / pixels, 0.0};
  if (variance == 0.0) return s;
  const double varianceOfMean = variance / (pixels * pixels);
  // Welch-Satterthwaite over the pixels: each estimate v has E[v^2] = sigma^4 (1 + 2 / dof), so the
  // sum's degrees of freedom are (dof + 2) (sum v)^2 / sum v^2.
  const double dof =
      std::isinf(dofPerPixel_) ? 1e12 : (dofPerPixel_ + 2.0) * variance * variance / squared;
  s.n = dof + 1.0;
  s.variance = varianceOfMean * s.n;
  return s;
}

}  // namespace restlab::stats
