// Rays and distances of a camera in double precision, before a scene is compiled, against boxes of
// a few triangles each.
#pragma once

#include <array>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

class Sight {
 public:
  explicit Sight(const Scene& scene);  // the scene must outlive it

  // Distance of the first surface along the ray, in lengths of `dirW`; infinite if there is none.
  double distanceTo(const glm::dvec3& originW, const glm::dvec3& dirW) const;
  // Distance from the point to the nearest surface, in metres; infinite if there is none. The
  // search may stop at the first surface nearer than `enough`.
  double distanceToNearest(const glm::dvec3& pointW, double enough) const;
  // Bounds of the vertices within `reach` of the point, by the largest coordinate difference; min >
  // max if there are none. Meshes used many times count by the corners of their boxes.
  std::array<glm::dvec3, 2> boundsWithin(const glm::dvec3& pointW, double reach) const;

 private:
  // Consecutive triangles of an instance; all of them if its mesh is used many times.
  struct Piece {
    uint32_t instance, first, count;
    glm::dvec3 low, high;
  };
  std::array<glm::dvec3, 3> corners(const Piece& piece, uint32_t triangle) const;

  const Scene& scene_;
  std::vector<Piece> pieces_;
};

// Distance from a point to a triangle, in double precision.
double distanceToTriangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c);

}  // namespace restlab
