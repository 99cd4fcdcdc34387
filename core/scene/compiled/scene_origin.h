// The origin of a compiled scene's coordinates. Kernels have 32-bit floats: a coordinate of a
// million metres is known to 6 cm, and rays from there start 2 m off the surface.
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
  // False: the origin is the middle of the scene's bounds, near enough to all that the camera sees.
  bool followsCamera = false;
  // Position of the main camera, the point it looks at (the median of its view) and the size that
  // must be resolved there, in metres: the height of the view, or the distance if that is less.
  // viewSize is 0 if the scene is so small that it does not matter.
  glm::dvec3 eyeW{0.0}, focusW{0.0};
  double viewSize = 0.0;
};

// Chooses the origin for the camera of that index (an index without a camera is allowed). A scene
// of harmless extent gets the middle of its bounds; otherwise the origin is the middle of all
// vertices within kHarmlessReach of what the camera sees. Visits every triangle once, and some of
// them a few times more if the scene is large for the camera's distance.
SceneOrigin originOf(const Scene& scene, uint32_t camera);

// Returns warnings about what 32-bit floats cannot resolve despite the chosen origin, each with the
// object's name: objects far from the origin of a scene that follows its camera, and cameras of the
// scene far from it.
std::vector<std::string> farFromOrigin(const Scene& scene, const SceneOrigin& origin);

}  // namespace restlab
