// A Lambert floor under one rectangle, tilted and turned. The rectangle is black and nothing else
// stands there, so the floor's radiance is albedo / pi times Lambert's polygon formula, exactly,
// from one scattering event on. The camera sees floor only, all of it in front of the rectangle's
// plane. A rectangle that grows would come between the floor and the first camera; the second one,
// "low", is in front of its plane and sees the floor below any rectangle.
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin_builder.h"
#include "core/scene/builtin_mesh.h"
#include "core/scene/builtin_scenes.h"

namespace restlab::builtin {

Scene makeQuadLight(double edge) {
  SceneBuilder scene("quad-light");
  const uint32_t floor = scene.addMaterial("floor", lambert({0.5f, 0.6f, 0.7f}));
  const uint32_t light =
      scene.addMaterial("light", lamp(glm::vec3(glm::dvec3(10.0, 8.0, 6.0) / (edge * edge))));
  scene.add(quad("floor", {-8.0, 0.0, 8.0}, {16.0, 0.0, 0.0}, {0.0, 0.0, -16.0}), floor);
  glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 2.0, -0.2));
  pose = glm::rotate(pose, glm::radians(25.0), glm::dvec3(0.0, 1.0, 0.0));
  pose = glm::rotate(pose, glm::radians(12.0), glm::dvec3(1.0, 0.0, 0.0));
  // Its normal is -y before the tilt.
  const glm::dvec3 u(1.5 * edge, 0.0, 0.0), v(0.0, 0.0, edge);
  scene.add(transformed(quad("light", -0.5 * (u + v), u, v), pose), light);
  scene.addCamera("floor", {0.0, 2.6, 4.6}, {0.0, 0.0, 0.2}, 36.0);
  scene.addCamera("low", {0.0, 0.9, 2.0}, {0.0, 0.0, 0.6}, 36.0);
  return scene.finish();
}

}  // namespace restlab::builtin
