// Samples of a function on a grid, for programs of fields (core/geometry/field/field.h): as words
// of a shape, and evaluated in double precision.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "core/scene/field/interval.h"

namespace restlab {

// Samples at the corners of the cells of a box, x fastest, at least two along each axis.
struct SampledGrid {
  glm::ivec3 samples{0};
  glm::dvec3 low{0.0}, high{0.0};  // places of the first sample and of the last one
  std::vector<float> values;
};

// 256^3 of them take 144 MB as words.
inline constexpr uint64_t kMostSamples = uint64_t{1} << 24;

// The words of a grid. They may belong to it or to the words of a shape.
class FieldGrid {
 public:
  explicit FieldGrid(const SampledGrid& grid);
  // Refers to words that outlive it.
  explicit FieldGrid(const uint32_t* words) : words_(words) {}

  // Interpolated along each axis in turn; beyond the box the value of the nearest place in it and
  // the distance to that.
  double at(const glm::dvec3& p) const;
  FieldRange over(const glm::dvec3& from, const glm::dvec3& to) const;

  // The box of all cells that have a sample of 0 or below; low > high: there is none.
  glm::dvec3 insideLow() const { return insideLow_; }
  glm::dvec3 insideHigh() const { return insideHigh_; }

  const uint32_t* words() const { return words_; }
  size_t size() const;  // words, whole uvec4s

 private:
  float number(size_t word) const;
  glm::uvec3 cells() const;
  glm::dvec3 vector(size_t word) const;
  double sample(const glm::uvec3& at) const;
  // Interpolated at a place in cells from the low corner; beyond, at the nearest one.
  double inside(const glm::dvec3& inGrid) const;

  std::shared_ptr<const std::vector<uint32_t>> owned_;
  const uint32_t* words_ = nullptr;
  glm::dvec3 insideLow_{1.0}, insideHigh_{0.0};
};

}  // namespace restlab
