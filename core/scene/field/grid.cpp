#include "core/scene/field/grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/geometry/field/field.h"

namespace restlab {

namespace {

constexpr float kEndless = std::numeric_limits<float>::max();
constexpr size_t kHeader = 4 * rl::RL_FIELD_GRID_HEADER;
constexpr size_t kBlockWords = 8;

// Least and largest of the value and of its derivatives along x, y and z, a cell.
struct GridBlock {
  std::array<float, kBlockWords> bounds{kEndless, -kEndless, kEndless, -kEndless,
                                        kEndless, -kEndless, kEndless, -kEndless};

  void take(size_t pair, float value) {
    bounds[2 * pair] = std::min(bounds[2 * pair], value);
    bounds[2 * pair + 1] = std::max(bounds[2 * pair + 1], value);
  }
  void take(const GridBlock& other) {
    for (size_t pair = 0; pair < 4; ++pair) {
      take(pair, other.bounds[2 * pair]);
      take(pair, other.bounds[2 * pair + 1]);
    }
  }
};

struct GridLevel {
  glm::ivec3 count{0};
  std::vector<GridBlock> blocks;

  explicit GridLevel(const glm::ivec3& of)
      : count(of), blocks(size_t(of.x) * size_t(of.y) * size_t(of.z)) {}
  GridBlock& at(const glm::ivec3& i) {
    return blocks[(size_t(i.z) * size_t(count.y) + size_t(i.y)) * size_t(count.x) + size_t(i.x)];
  }
};

template <class Visit>
void forEachBlock(const glm::ivec3& count, const Visit& visit) {
  glm::ivec3 i;
  for (i.z = 0; i.z < count.z; ++i.z)
    for (i.y = 0; i.y < count.y; ++i.y)
      for (i.x = 0; i.x < count.x; ++i.x) visit(i);
}

// Blocks of 2^3 cells. Samples and edges between blocks are those of both.
GridLevel finestBlocks(const SampledGrid& grid) {
  const glm::ivec3 cells = grid.samples - 1;
  const auto at = [&](const glm::ivec3& i) {
    return grid
        .values[(size_t(i.z) * size_t(grid.samples.y) + size_t(i.y)) * size_t(grid.samples.x) +
                size_t(i.x)];
  };
  GridLevel level((cells + 1) / 2);
  forEachBlock(level.count, [&](const glm::ivec3& block) {
    GridBlock& of = level.at(block);
    const glm::ivec3 low = 2 * block, high = glm::min(low + 2, cells);
    glm::ivec3 i;
    for (i.z = low.z; i.z <= high.z; ++i.z)
      for (i.y = low.y; i.y <= high.y; ++i.y)
        for (i.x = low.x; i.x <= high.x; ++i.x) {
          of.take(0, at(i));
          for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 next = i;
            ++next[axis];
            if (next[axis] <= high[axis]) of.take(size_t(axis) + 1, at(next) - at(i));
          }
        }
  });
  // Rounding of what kernels interpolate.
  for (GridBlock& of : level.blocks) {
    const float error =
        rl::RL_FIELD_GRID_ERROR * std::max(std::abs(of.bounds[0]), std::abs(of.bounds[1]));
    for (size_t i = 0; i < kBlockWords; ++i) of.bounds[i] += i % 2 == 0 ? -error : error;
  }
  return level;
}

GridLevel coarser(GridLevel& fine) {
  GridLevel level((fine.count + 1) / 2);
  forEachBlock(fine.count, [&](const glm::ivec3& i) { level.at(i / 2).take(fine.at(i)); });
  return level;
}

std::vector<uint32_t> gridWordsOf(const SampledGrid& grid) {
  std::vector<uint32_t> words;
  const auto put = [&](double v) { words.push_back(std::bit_cast<uint32_t>(float(v))); };
  const glm::dvec3 cell = (grid.high - grid.low) / glm::dvec3(grid.samples - 1);
  const std::array<glm::dvec3, 3> rows{grid.low, 1.0 / cell, grid.high};
  for (int row = 0; row < 3; ++row) {
    for (int c = 0; c < 3; ++c) put(rows[size_t(row)][c]);
    words.push_back(uint32_t(grid.samples[row]));
  }
  for (const float v : grid.values) words.push_back(std::bit_cast<uint32_t>(v));
  words.resize((words.size() + 3) / 4 * 4, 0);
  GridLevel level = finestBlocks(grid);
  for (;;) {
    for (const GridBlock& block : level.blocks)
      for (const float bound : block.bounds) put(bound);
    if (level.blocks.size() == 1) return words;
    level = coarser(level);
  }
}

}  // namespace

FieldGrid::FieldGrid(const SampledGrid& grid)
    : owned_(std::make_shared<const std::vector<uint32_t>>(gridWordsOf(grid))),
      words_(owned_->data()) {
  const glm::dvec3 low = vector(0), cell = 1.0 / vector(4);
  glm::ivec3 first(std::numeric_limits<int>::max()), last(-1);
  forEachBlock(grid.samples, [&](const glm::ivec3& i) {
    if (sample(glm::uvec3(i)) > 0.0) return;
    first = glm::min(first, i - 1);
    last = glm::max(last, i + 1);
  });
  if (last.x < 0) return;
  insideLow_ = low + glm::dvec3(glm::max(first, 0)) * cell;
  insideHigh_ = low + glm::dvec3(glm::min(last, grid.samples - 1)) * cell;
}

float FieldGrid::number(size_t word) const { return std::bit_cast<float>(words_[word]); }
glm::dvec3 FieldGrid::vector(size_t word) const {
  return {number(word), number(word + 1), number(word + 2)};
}
glm::uvec3 FieldGrid::cells() const {
  return glm::uvec3(words_[3], words_[7], words_[11]) - glm::uvec3(1);
}
double FieldGrid::sample(const glm::uvec3& at) const {
  const size_t row = words_[3], layer = row * words_[7];
  return double(number(kHeader + at.z * layer + at.y * row + at.x));
}

size_t FieldGrid::size() const {
  size_t words = kHeader + (size_t(words_[3]) * words_[7] * words_[11] + 3) / 4 * 4;
  for (glm::uvec3 count = cells();;) {
    count = (count + glm::uvec3(1)) / glm::uvec3(2);
    const size_t blocks = size_t(count.x) * count.y * count.z;
    words += kBlockWords * blocks;
    if (blocks == 1) return words;
  }
}

double FieldGrid::inside(const glm::dvec3& inGrid) const {
  const glm::dvec3 nearest = glm::clamp(inGrid, glm::dvec3(0.0), glm::dvec3(cells()));
  const glm::uvec3 cell = glm::min(glm::uvec3(nearest), cells() - glm::uvec3(1));
  const glm::dvec3 in = nearest - glm::dvec3(cell);
  std::array<double, 4> lines;
  for (uint32_t k = 0; k < 4; ++k) {
    const glm::uvec3 from = cell + glm::uvec3(0, k & 1, k >> 1);
    lines[k] = glm::mix(sample(from), sample(from + glm::uvec3(1, 0, 0)), in.x);
  }
  return glm::mix(glm::mix(lines[0], lines[1], in.y), glm::mix(lines[2], lines[3], in.y), in.z);
}

double FieldGrid::at(const glm::dvec3& p) const {
  return inside((p - vector(0)) * vector(4)) + glm::length(p - glm::clamp(p, vector(0), vector(8)));
}

FieldRange FieldGrid::over(const glm::dvec3& from, const glm::dvec3& to) const {
  const glm::dvec3 least(0.0), most(cells());
  const glm::dvec3 fromGrid = (from - vector(0)) * vector(4), toGrid = (to - vector(0)) * vector(4);
  const glm::dvec3 low = glm::clamp(fromGrid, least, most), high = glm::clamp(toGrid, least, most);
  glm::uvec3 first = glm::min(glm::uvec3(low), cells() - glm::uvec3(1));
  glm::uvec3 last = glm::min(glm::uvec3(high), cells() - glm::uvec3(1));
  FieldRange range{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  const auto take = [&](double v) {
    range.low = std::min(range.low, v);
    range.high = std::max(range.high, v);
  };
  const auto isWide = [&] {
    const glm::uvec3 span = last - first;
    return std::max({span.x, span.y, span.z}) > 1;
  };
  if (!isWide()) {
    // Values are linear along each axis between the box's ends and the sides of cells.
    std::array<std::vector<double>, 3> stops;
    for (int c = 0; c < 3; ++c) {
      stops[size_t(c)] = {low[c], high[c]};
      if (last[c] > first[c]) stops[size_t(c)].push_back(double(last[c]));
    }
    for (const double z : stops[2])
      for (const double y : stops[1])
        for (const double x : stops[0]) take(inside({x, y, z}));
    const double slack = 1e-6 * std::max(-range.low, range.high);
    range.low -= slack;
    range.high += slack;
  } else {
    size_t blocks = kHeader + (size_t(words_[3]) * words_[7] * words_[11] + 3) / 4 * 4;
    glm::uvec3 count = cells();
    for (bool isFirst = true; isWide(); isFirst = false) {
      if (!isFirst) blocks += kBlockWords * (size_t(count.x) * count.y * count.z);
      count = (count + glm::uvec3(1)) / glm::uvec3(2);
      first /= 2u;
      last /= 2u;
    }
    glm::uvec3 i;
    for (i.z = first.z; i.z <= last.z; ++i.z)
      for (i.y = first.y; i.y <= last.y; ++i.y)
        for (i.x = first.x; i.x <= last.x; ++i.x) {
          const size_t block =
              blocks + kBlockWords * ((size_t(i.z) * count.y + i.y) * count.x + i.x);
          take(number(block));
          take(number(block + 1));
        }
  }
  glm::dvec3 nearest(0.0), furthest(0.0);
  for (int c = 0; c < 3; ++c) {
    const double a = from[c] - glm::clamp(from[c], vector(0)[c], vector(8)[c]),
                 b = to[c] - glm::clamp(to[c], vector(0)[c], vector(8)[c]);
    nearest[c] = a > 0.0 ? a : b < 0.0 ? b : 0.0;
    furthest[c] = std::max(std::abs(a), std::abs(b));
  }
  return {range.low + glm::length(nearest), range.high + glm::length(furthest)};
}

}  // namespace restlab
