// Lambert's formula (1760) for the irradiance from a uniform polygon: exact, no sampling.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace restlab::analytic {

// Part of a planar polygon with dot(v - pos, normal) >= 0, in the order of its vertices; empty when
// none of it is above the horizon.
std::vector<glm::dvec3> clipToHorizon(const std::vector<glm::dvec3>& vertices,
                                      const glm::dvec3& pos, const glm::dvec3& normal);

// The integral of cos(theta) over the solid angle that the polygon fills above the horizon of
// `pos`, in sr: irradiance per radiance, pi for the whole hemisphere. `normal` is unit. Positive
// when `pos` sees the vertices counter-clockwise (the polygon's front), negative when it sees them
// clockwise. The polygon is planar and simple; `pos` is not on it.
double projectedSolidAngle(const std::vector<glm::dvec3>& vertices, const glm::dvec3& pos,
                           const glm::dvec3& normal);

}  // namespace restlab::analytic
