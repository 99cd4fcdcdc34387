// Cameras and camera paths of the bias tests.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::bias {

// Upright at `eye`, looking at `target`; the field of view is vertical, in degrees.
SceneCamera lookAt(const glm::dvec3& eye, const glm::dvec3& target, double yfovDegrees);

// Inside the Cornell box, the lamp just out of view.
SceneCamera cornellBelowTheLamp();

// `frames` cameras that walk and turn from a beginning to `end`, which is the last one: every frame
// sees other points in other pixels, and some for the first time. `stepW` is the walk of a frame in
// metres, `turnDegrees` its turn about the vertical.
std::vector<SceneCamera> walkTo(const SceneCamera& end, uint32_t frames, const glm::dvec3& stepW,
                                double turnDegrees);

}  // namespace restlab::bias
