// Rays and distances of a camera in double precision, before anything is compiled, against boxes of
// a few triangles each.
#pragma once

#include <array>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

class Sight {
 public:
  explicit Sight(const Scene& scene);  // which must outlive it

  // Distance of the first surface along the ray, in lengths of `dirW`; infinite where there is
  // none.
  double distanceTo(const glm::dvec3& originW, const glm::dvec3& dirW) const;
  // From the point to the nearest surface, in metres; infinite where there is none. It may stop at
  // the first one nearer than `enough`.
  double distanceToNearest(const glm::dvec3& pointW, double enough) const;
  // Bounds of the vertices that are no farther than `reach` from the point, by their largest
  // coordinate; min > max where there is none. Forests count by the corners of their boxes.
  std::array<glm::dvec3, 2> boundsWithin(const glm::dvec3& pointW, double reach) const;

 private:
  // Consecutive triangles of an instance; all of them where its mesh is used many times.
  struct Piece {
    uint32_t instance, first, count;
    glm::dvec3 low, high;
  };
  std::array<glm::dvec3, 3> corners(const Piece& piece, uint32_t triangle) const;

  const Scene& scene_;
  std::vector<Piece> pieces_;
};

// From a point to a triangle, in double precision.
double distanceToTriangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c);

}  // namespace restlab
