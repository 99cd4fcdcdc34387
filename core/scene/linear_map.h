// Linear maps that lose a dimension, or nearly: how close they are to it, what remains of space.
#pragma once

#include <glm/glm.hpp>

namespace restlab {

// Length of an axis below which its direction is undefined.
inline constexpr double kSmallestScale = 1e-30;
// Regularity below which a map counts as losing a dimension.
inline constexpr double kSmallestRegularity = 1e-9;

// Measures how far a map is from losing a dimension by shear: |determinant| over the product of the
// lengths of the axes, 0 when an axis has no length. 1 for any rotation with any scale.
double regularity(const glm::dmat3& linear);

// Right-handed, orthonormal axes: Z along the map's Z, X as near to the map's X as that allows. A
// mirroring map is read as a rotation times a scale with one or three negative numbers: of the four
// possible rotations, the one by the smallest angle. Axes without length are completed.
glm::dmat3 nearestRotation(const glm::dmat3& linear);

// Shape of a map that makes space much flatter along one direction than along the others.
struct Flatness {
  glm::dvec3 normal{0.0};  // unit normal of the plane that remains
  glm::dvec3 lost{0.0};    // unit; the direction, before the map, that is flattened
  double stretch = 0.0;    // along `normal`, of a unit along `lost`; signed
  double ratio = 1.0;      // |stretch| over the next larger stretch
  double inPlane = 0.0;    // the next larger stretch; 0: at most a line remains
};
Flatness flatnessOf(const glm::dmat3& linear);

// Returns the map with another stretch along the normal.
glm::dmat3 withStretch(const glm::dmat3& linear, const Flatness& flatness, double stretch);

}  // namespace restlab
