// A camera at a point, its axes, and the check that they are a rotation.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/scene.h"

namespace restlab {

inline SceneCamera cameraAtPoint(const char* name, const glm::dvec3& eye, const glm::dvec3& target,
                                 const glm::dvec3& upW = {0, 1, 0}) {
  SceneCamera camera;
  camera.name = name;
  camera.yfov = 0.7;
  camera.aspect = 1.5;
  camera.cameraToWorld = glm::inverse(glm::lookAt(eye, target, upW));
  return camera;
}

// Unit vector.
inline glm::dvec3 forward(const SceneCamera& camera) {
  return -glm::normalize(glm::dvec3(camera.cameraToWorld[2]));
}

inline void expectOrthonormal(const SceneCamera& camera) {
  const glm::dmat3 basis(camera.cameraToWorld);
  const glm::dmat3 product = glm::transpose(basis) * basis;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(product[i][k], i == k ? 1.0 : 0.0, 1e-12);
  }
  EXPECT_NEAR(glm::determinant(basis), 1.0, 1e-12);
  EXPECT_EQ(camera.cameraToWorld[3].w, 1.0);
}

}  // namespace restlab
