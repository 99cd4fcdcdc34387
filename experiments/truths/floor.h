// Exact image of "floor": white Lambert under a sky of radiance 1, changed by its parameters.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {

// Irradiance over pi of a plane with normal +Y under a latitude-longitude map of radiance 1 with
// one pixel of radiance `sun`. That pixel is spread bilinearly to the middles of its neighbours.
// With h = pi / height, at theta from the zenith:
//   1 + (sun - 1) (2 / width) (sin(2 theta) / 2) sin^2(h) / h.
double sunlitRadiance(double sun, double thetaOfSun, uint32_t width, uint32_t height);

// Radiance of a Lambert plane of albedo 1 under a uniform sky of radiance 1 if its shading normal
// leans by an angle and directions below the plane are absorbed: (1 + cos) / 2.
double leaningRadiance(double cosineOfSlope);

// Radiance from spots alone: intensity x falloff x cosine / (pi d^2), summed.
glm::dvec3 spotlitRadiance(const std::vector<PunctualLight>& spots, const glm::dvec3& posW);

// Implement whyNotExact() and exactImage() for this scene.
std::string whyNotFloor(const Scene& floor, const ExactView& view);
std::vector<glm::dvec3> floorImage(const Scene& floor, const ExactView& view);

}  // namespace restlab::analytic
