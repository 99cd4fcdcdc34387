// Lambert's formula (1760) for the irradiance from a uniform polygon: exact, no sampling.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace restlab::analytic {

// Returns the part of a planar polygon with dot(v - pos, normal) >= 0, in the order of its
// vertices; empty if none of it is above the horizon.
std::vector<glm::dvec3> clipToHorizon(const std::vector<glm::dvec3>& vertices,
                                      const glm::dvec3& pos, const glm::dvec3& normal);

// Returns the integral of cos(theta) over the solid angle that the polygon covers above the horizon
// of `pos`, in sr: irradiance per radiance, pi for the whole hemisphere. `normal` is unit. Positive
// if `pos` sees the vertices counter-clockwise (the polygon's front), negative if clockwise. The
// polygon must be planar and simple, and `pos` not on it.
double projectedSolidAngle(const std::vector<glm::dvec3>& vertices, const glm::dvec3& pos,
                           const glm::dvec3& normal);

}  // namespace restlab::analytic
