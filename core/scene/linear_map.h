// Linear maps that lose a dimension, or nearly: how far they are from it, what is left of them.
#pragma once

#include <glm/glm.hpp>

namespace restlab {

// Shorter axes have no direction.
inline constexpr double kSmallestScale = 1e-30;
// Below this a map counts as one that loses a dimension.
inline constexpr double kSmallestRegularity = 1e-9;

// How far a map is from losing a dimension by shear: |determinant| over the product of the lengths
// of the axes, 0 when an axis has no length. 1 for any rotation with any scale.
double regularity(const glm::dmat3& linear);

// Right-handed and orthonormal: Z along that of the map, X as near to that of the map as that
// allows. A map that mirrors is read as a rotation times a scale with one negative number, or
// three: of the four rotations the one by the smallest angle. Axes without length are completed.
glm::dmat3 nearestRotation(const glm::dmat3& linear);

// The shape of a map that makes space much flatter along one direction than along the others.
struct Flatness {
  glm::dvec3 normal{0.0};  // unit: of the plane that is left
  glm::dvec3 lost{0.0};    // unit: the direction, before the map, that is flattened
  double stretch = 0.0;    // along `normal`, of a unit along `lost`; signed
  double ratio = 1.0;      // of |stretch| to the next larger stretch
  double inPlane = 0.0;    // that next larger stretch; 0: no more than a line is left
};
Flatness flatnessOf(const glm::dmat3& linear);

// The map with another stretch along the normal.
glm::dmat3 withStretch(const glm::dmat3& linear, const Flatness& flatness, double stretch);

}  // namespace restlab
