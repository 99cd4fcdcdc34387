// The point that a compiled scene counts its coordinates from. Kernels have 32-bit floats: a
// coordinate of a million metres is known to 6 cm, and rays from there start 2 m off the surface.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// Coordinates up to this many times the size of what is seen do no harm: a ray starts off a surface
// by RL_HIT_ERROR times the coordinate, 1/2000 of that size.
constexpr double kHarmlessReach = 256.0;

struct SceneOrigin {
  glm::dvec3 originW{0.0};  // metres
  // False: the middle of the scene's bounds, from which all that the camera sees is near enough.
  bool followsCamera = false;
  // The point that the main camera looks at (the median of its view) and the size that must be told
  // apart there, in metres: the height of the view, or the distance where that is less. viewSize is
  // 0 where the scene is so small that it does not matter.
  glm::dvec3 eyeW{0.0}, focusW{0.0};
  double viewSize = 0.0;
};

// For the camera of that index (none is needed). A scene of harmless extent has the middle of its
// bounds for an origin; elsewhere it is the middle of all vertices that lie within kHarmlessReach
// of what the camera sees. Looks at every triangle once, and at some of them a few times more where
// the scene is large for the camera's distance.
SceneOrigin originOf(const Scene& scene, uint32_t camera);

// Lines about what 32-bit floats cannot hold all the same, each with the object's name: objects far
// from the origin of a scene that follows its camera, and cameras of the scene far from it.
std::vector<std::string> farFromOrigin(const Scene& scene, const SceneOrigin& origin);

}  // namespace restlab
