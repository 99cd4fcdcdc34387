// Exact images of built-in scenes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::analytic {

// Names of the built-in scenes with an exact image.
const std::vector<std::string>& exactSceneNames();

struct ExactView {
  uint32_t camera = 0;                              // index in the scene
  std::optional<SceneCamera> moved = std::nullopt;  // replaces it
  uint32_t width = 0, height = 0;
  uint32_t scatteringEvents = 0;
  bool multiscatter = false;
};

// Returns why the view has no exact image, as words that follow the scene's name; "" if it has one.
// `scene`: a built-in one, neither scaled nor moved; its lights may be switched or dimmed.
std::string whyNotExact(const Scene& scene, const ExactView& view);

// Bound of the error of an exact image, as a share of its brightest pixel.
inline constexpr double kExactError = 1e-5;

// Returns the radiance per pixel (row 0 on top, width x height) under the box filter of one pixel,
// for paths of at most `scatteringEvents`. The error is below kExactError of the brightest pixel,
// with three exceptions: metal in "sphere-furnace" is as exact as the compensation of its roughness
// (docs/manual.md); glass in "floor" lacks less than 1e-3 of its light, which takes more than 64
// events; more than 1000 spots over "floor" are averaged over 2 x 2 points per pixel. Throws
// std::invalid_argument if there is no exact image.
std::vector<glm::dvec3> exactImage(const Scene& scene, const ExactView& view);

}  // namespace restlab::analytic
