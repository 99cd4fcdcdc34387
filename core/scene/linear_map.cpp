#include "core/scene/linear_map.h"

#include <algorithm>
#include <cmath>

namespace restlab {

namespace {

// Largest cross product of two of the three axes.
glm::dvec3 largestCross(const glm::dmat3& m) {
  glm::dvec3 largest = glm::cross(m[0], m[1]);
  for (const glm::dvec3& other : {glm::cross(m[1], m[2]), glm::cross(m[2], m[0])})
    if (glm::length(other) > glm::length(largest)) largest = other;
  return largest;
}

double longestAxis(const glm::dmat3& m) {
  return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
}

// Returns the unit vector perpendicular to `notAlong` in the direction of the first of `vectors`
// that is not parallel to it.
glm::dvec3 directionAcross(const glm::dvec3& notAlong, std::initializer_list<glm::dvec3> vectors) {
  for (const glm::dvec3& v : vectors) {
    const double length = glm::length(v);
    if (!(length > kSmallestScale)) continue;
    const glm::dvec3 across = v / length - glm::dot(v / length, notAlong) * notAlong;
    if (glm::length(across) > kSmallestRegularity) return glm::normalize(across);
  }
  return glm::dvec3(0.0);
}

}  // namespace

double regularity(const glm::dmat3& linear) {
  glm::dmat3 unit;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(linear[axis]);
    if (!(length > kSmallestScale)) return 0.0;
    unit[axis] = linear[axis] / length;
  }
  return std::abs(glm::determinant(unit));
}

glm::dmat3 nearestRotation(const glm::dmat3& linear) {
  const glm::dvec3 none(0.0);
  const glm::dvec3 z = directionAcross(
      none, {linear[2], glm::cross(linear[0], linear[1]), glm::dvec3(0.0, 0.0, 1.0)});
  const glm::dvec3 x = directionAcross(z, {linear[0], glm::cross(linear[1], z),
                                           glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)});
  const bool mirrors = regularity(linear) > kSmallestRegularity && glm::determinant(linear) < 0.0;
  if (!mirrors) return glm::dmat3(x, glm::cross(z, x), z);
  const glm::dvec3 y = glm::cross(x, z);
  glm::dmat3 nearest(-x, -y, -z);
  const auto trace = [](const glm::dmat3& m) { return m[0].x + m[1].y + m[2].z; };
  for (const glm::dmat3& other : {glm::dmat3(-x, y, z), glm::dmat3(x, -y, z), glm::dmat3(x, y, -z)})
    if (trace(other) > trace(nearest)) nearest = other;
  return nearest;
}

Flatness flatnessOf(const glm::dmat3& linear) {
  Flatness flatness;
  const glm::dvec3 across = largestCross(linear);
  const double longest = longestAxis(linear), area = glm::length(across);
  if (!(longest > kSmallestScale) || !(area > kSmallestRegularity * longest * longest))
    return flatness;
  flatness.normal = across / area;
  flatness.lost = glm::normalize(largestCross(glm::transpose(linear)));
  flatness.stretch = glm::dot(flatness.normal, linear * flatness.lost);
  flatness.inPlane = area / longest;
  flatness.ratio = std::abs(glm::determinant(linear)) / (area * flatness.inPlane);
  return flatness;
}

glm::dmat3 withStretch(const glm::dmat3& linear, const Flatness& flatness, double stretch) {
  return linear + glm::outerProduct(flatness.normal, (stretch - flatness.stretch) * flatness.lost);
}

}  // namespace restlab
