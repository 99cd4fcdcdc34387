// Exact image of "quad-light": a Lambert floor under one rectangle.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {

// Returns the radiance that a point of the floor sends up: albedo / pi times Lambert's polygon
// formula of the rectangle and of the brightest of its triangles.
glm::dvec3 quadLightRadiance(const Scene& quadLight, const glm::dvec3& posW);

// Implement whyNotExact() and exactImage() for this scene.
std::string whyNotQuadLight(const Scene& quadLight, const ExactView& view);
std::vector<glm::dvec3> quadLightImage(const Scene& quadLight, const ExactView& view);

}  // namespace restlab::analytic
