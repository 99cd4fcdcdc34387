// Rays against single triangles in double precision, for use before a scene is compiled.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace restlab {

// Distance, in lengths of `dir`, at which a ray from `origin` meets a triangle from either side;
// infinite if it misses (Moeller & Trumbore 1997).
inline double distanceToTriangle(const glm::dvec3& origin, const glm::dvec3& dir,
                                 const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const glm::dvec3 edge1 = b - a, edge2 = c - a, across = glm::cross(dir, edge2);
  const double determinant = glm::dot(edge1, across);
  if (determinant == 0.0) return kNone;
  const glm::dvec3 offset = origin - a;
  const double u = glm::dot(offset, across) / determinant;
  const glm::dvec3 turned = glm::cross(offset, edge1);
  const double v = glm::dot(dir, turned) / determinant;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return kNone;
  const double t = glm::dot(edge2, turned) / determinant;
  return t > 0.0 ? t : kNone;
}

}  // namespace restlab
