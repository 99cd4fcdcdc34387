// The tree of a solid as it is written.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/field/grid.h"
#include "core/scene/field/reader.h"

namespace restlab {

// Order of solidForms().
enum class SolidKind {
  sphere,
  box,
  torus,
  capsule,
  cylinder,
  plane,
  unite,
  intersect,
  subtract,
  smoothUnite,
  smoothIntersect,
  smoothSubtract,
  round,
  shell,
  translate,
  rotate,
  scale,
  repeat,
  twist,
  displace,
  grid,
};

struct Solid {
  SolidKind kind = SolidKind::sphere;
  std::vector<double> numbers;
  std::vector<Solid> parts;
  TextSpan span;
  std::shared_ptr<const FieldGrid> grid{};  // one object a file
};

// Reads the grid of a name. Throws Error (badInput).
using GridFiles = std::function<FieldGrid(const std::string& name)>;

// Throws Error (badInput): the place in the text, what is wrong, what would be right. Without
// files, trees with grids are refused.
Solid readSolidTree(const std::string& text, const GridFiles& files = {});

struct SolidBox {
  glm::dvec3 low, high;
};

// A box around the solid; nullopt: it has no end.
std::optional<SolidBox> boundsOf(const Solid& solid);

}  // namespace restlab
