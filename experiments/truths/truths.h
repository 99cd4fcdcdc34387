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

struct ExactView {
  uint32_t camera = 0;
  uint32_t width = 0, height = 0;
  uint32_t scatteringEvents = 0;
  bool multiscatter = false;
};

// Why there is no exact image of the view, in words that follow the scene's name; "": there is one.
// `scene` is a built-in one that was neither scaled, moved nor lit otherwise.
std::string whyNotExact(const Scene& scene, const ExactView& view);

// Radiance per pixel (row 0 on top, width x height) under the box filter of one pixel, for paths of
// at most `scatteringEvents`. Error below 1e-5 of the brightest pixel ("quad-light" averages 8 x 8
// Gauss points a pixel; the furnaces are constant; metal in "sphere-furnace" is as exact as the
// compensation of its roughness, docs/manual.md). Throws std::invalid_argument where there is none.
std::vector<glm::dvec3> exactImage(const Scene& scene, const ExactView& view);

// Radiance that "quad-light" sends up from a point of its floor.
glm::dvec3 quadLightRadiance(const Scene& quadLight, const glm::dvec3& posW);

}  // namespace restlab::analytic
