// Tells which points are inside a closed surface.
#pragma once

#include "core/scene/splines/bezier.h"

namespace restlab {

// Whether the edges of a surface meet or are points, with the normals to the outside. Surfaces that
// only others close are open.
bool isClosedSurface(const BezierGrid& grid);

// A closed surface with samples for its closest points.
class ClosedSurface {
 public:
  explicit ClosedSurface(BezierGrid grid);
  // Whether a point is on the inner side of the closest point of the surface.
  bool isInside(const glm::dvec3& p) const;

 private:
  struct Sample {
    glm::dvec3 position, normal;
    size_t piece;
    glm::dvec2 st;
  };
  BezierGrid grid_;
  std::vector<Sample> samples_;
  double spacing_ = 0.0;  // largest distance of neighbours
};

}  // namespace restlab
