#include "tests/bias/test_cameras.h"

#include <glm/gtc/matrix_transform.hpp>

namespace restlab::bias {

SceneCamera lookAt(const glm::dvec3& eye, const glm::dvec3& target, double yfovDegrees) {
  SceneCamera camera;
  camera.name = "test";
  camera.yfov = glm::radians(yfovDegrees);
  camera.cameraToWorld = glm::inverse(glm::lookAt(eye, target, glm::dvec3(0.0, 1.0, 0.0)));
  return camera;
}

SceneCamera cornellBelowTheLamp() { return lookAt({-2.78, 3.9, 0.4}, {-2.78, 1.0, -3.6}, 55.0); }

std::vector<SceneCamera> walkTo(const SceneCamera& end, uint32_t frames, const glm::dvec3& stepW,
                                double turnDegrees) {
  std::vector<SceneCamera> cameras;
  for (uint32_t i = 0; i < frames; ++i) {
    const double before = double(frames - 1 - i);
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), -glm::radians(turnDegrees) * before,
                                        glm::dvec3(0.0, 1.0, 0.0));
    SceneCamera camera = end;
    glm::dmat4 rotation = end.cameraToWorld;
    rotation[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
    camera.cameraToWorld = turn * rotation;
    camera.cameraToWorld[3] = end.cameraToWorld[3] - glm::dvec4(stepW * before, 0.0);
    cameras.push_back(camera);
  }
  return cameras;
}

}  // namespace restlab::bias
