// CompiledScene::camera(): converts a camera of the scene to the form that kernels read.
#include <cmath>

#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

rl::Camera CompiledScene::camera(const SceneCamera& camera, uint32_t width, uint32_t height) const {
  const glm::dmat4& m = camera.cameraToWorld;
  const glm::dvec3 right = glm::normalize(glm::dvec3(m[0]));
  const glm::dvec3 back = glm::normalize(glm::dvec3(m[2]));
  const glm::dvec3 up = glm::normalize(glm::cross(back, right));
  rl::Camera c{};
  c.posW = glm::vec3(glm::dvec3(m[3]) - origin());
  c.kind = camera.kind;
  c.rightW = glm::vec3(glm::normalize(glm::cross(up, back)));
  if (camera.isMirrored) c.rightW = -c.rightW;
  c.upW = glm::vec3(up);
  c.forwardW = glm::vec3(-back);
  c.shiftX = static_cast<float>(camera.shift.x);
  c.shiftY = static_cast<float>(camera.shift.y);
  const double aspect = double(width) / double(height);
  if (camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC) {
    c.halfHeight = static_cast<float>(camera.ymag);
    c.halfWidth = static_cast<float>(camera.ymag * aspect);
  } else {
    const double t = std::tan(0.5 * camera.yfov);
    c.halfHeight = static_cast<float>(t);
    c.halfWidth = static_cast<float>(t * aspect);
  }
  return c;
}

}  // namespace restlab
