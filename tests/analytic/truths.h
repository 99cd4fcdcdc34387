// The exact images of the built-in scenes that have one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::analytic {

// Names of the built-in scenes with an exact image.
const std::vector<std::string>& exactSceneNames();

// Radiance per pixel (row 0 on top, width x height) under the box filter of one pixel, for paths of
// at most `scatteringEvents`, from the scene's first camera. Error below 1e-5 of the brightest
// pixel
// ("quad-light" averages 8 x 8 Gauss points a pixel; the furnaces are constant; the outline of
// "sphere-furnace" matters at 0 events only, which is refused). Throws std::invalid_argument for a
// scene or limit without an exact image.
std::vector<glm::dvec3> exactImage(const Scene& scene, uint32_t width, uint32_t height,
                                   uint32_t scatteringEvents);

// Radiance that "quad-light" sends up from a point of its floor.
glm::dvec3 quadLightRadiance(const Scene& quadLight, const glm::dvec3& posW);

}  // namespace restlab::analytic
