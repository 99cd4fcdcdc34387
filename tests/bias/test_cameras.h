// Cameras and camera paths of the bias tests.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::bias {

// Upright camera at `eye`, looking at `target`; vertical field of view in degrees.
SceneCamera lookAt(const glm::dvec3& eye, const glm::dvec3& target, double yfovDegrees);

// Inside the Cornell box, with the lamp just out of view.
SceneCamera cornellBelowTheLamp();

// Returns `frames` cameras that move and turn until `end`, the last one: every frame sees other
// points in other pixels, and some for the first time. `stepW`: metres per frame; `turnDegrees`:
// turn per frame about the vertical.
std::vector<SceneCamera> walkTo(const SceneCamera& end, uint32_t frames, const glm::dvec3& stepW,
                                double turnDegrees);

}  // namespace restlab::bias
