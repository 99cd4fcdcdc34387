// Programs of fields (core/geometry/field/field.h) on the host: made, packed, and evaluated in
// double precision.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/field/field.h"
#include "core/scene/field/grid.h"
#include "core/scene/field/interval.h"

namespace restlab {

struct FieldInstruction {
  uint32_t kind = 0, to = 0, a = 0, b = 0;
  std::array<float, 3> constants{};
  uint32_t c = 0, grid = 0;  // of RL_FIELD_GRID: its third place, and which grid
};

// Result of one instruction but RL_FIELD_GRID, of its arguments or of the place p.
double fieldValue(const FieldInstruction& i, double a, double b, const glm::dvec3& p);

// A function of the place, above 0 outside of the surface, in a box that cuts it off.
struct FieldProgram {
  glm::vec3 low{0.0f}, high{0.0f};
  bool isClosed = false;
  std::vector<FieldInstruction> instructions;
  std::vector<FieldGrid> grids;

  double at(const glm::dvec3& p) const;
  glm::dvec3 gradientAt(const glm::dvec3& p) const;
  // Bounds over a box. refuses(i, of): asked for the argument of each instruction that may be
  // undefined, with its bounds; what it returns is left to it.
  using Check = std::function<bool(size_t instruction, FieldRange argument)>;
  FieldRange over(const glm::dvec3& from, const glm::dvec3& to, const Check& refuses = {}) const;
};

// As words of a shape, and back; grids of the result refer to the words.
std::vector<uint32_t> fieldWords(const FieldProgram& program);
FieldProgram fieldProgram(const std::vector<uint32_t>& words);

// Whether the field is above 0 on the whole of the box's faces: no part of the surface is cut off.
bool isFieldClosed(const FieldProgram& program);

}  // namespace restlab
