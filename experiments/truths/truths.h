// The exact images of the built-in scenes that have one.
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
  uint32_t camera = 0;                              // of the scene's
  std::optional<SceneCamera> moved = std::nullopt;  // instead of it
  uint32_t width = 0, height = 0;
  uint32_t scatteringEvents = 0;
  bool multiscatter = false;
};

// Why there is no exact image of the view, in words that follow the scene's name; "": there is one.
// `scene` is a built-in one that was neither scaled nor moved; its lights may be switched or
// dimmed.
std::string whyNotExact(const Scene& scene, const ExactView& view);

// Radiance per pixel (row 0 on top, width x height) under the box filter of one pixel, for paths of
// at most `scatteringEvents`. Error below 1e-5 of the brightest pixel; but metal in
// "sphere-furnace" is as exact as the compensation of its roughness (docs/manual.md), glass in
// "floor" lacks less than 1e-3 of its light, which takes more than 64 events, and more than 1000
// spots over it are averaged over 2 x 2 points a pixel. Throws std::invalid_argument where there is
// none.
std::vector<glm::dvec3> exactImage(const Scene& scene, const ExactView& view);

}  // namespace restlab::analytic
