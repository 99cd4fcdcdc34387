// A Lambert floor under one rectangle, tilted and turned. The rectangle is black and nothing else
// stands there, so the floor's radiance is albedo / pi times Lambert's polygon formula, exactly,
// from one scattering event on. The camera sees floor only, all of it in front of the rectangle's
// plane.
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin_builder.h"
#include "core/scene/builtin_mesh.h"
#include "core/scene/builtin_scenes.h"

namespace restlab::builtin {

Scene makeQuadLight() {
  SceneBuilder scene("quad-light");
  const uint32_t floor = scene.addMaterial("floor", lambert({0.5f, 0.6f, 0.7f}));
  const uint32_t light = scene.addMaterial("light", lamp({10.0f, 8.0f, 6.0f}));
  scene.add(quad("floor", {-8.0, 0.0, 8.0}, {16.0, 0.0, 0.0}, {0.0, 0.0, -16.0}), floor);
  glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 2.0, -0.2));
  pose = glm::rotate(pose, glm::radians(25.0), glm::dvec3(0.0, 1.0, 0.0));
  pose = glm::rotate(pose, glm::radians(12.0), glm::dvec3(1.0, 0.0, 0.0));
  // Its normal is -y before the tilt.
  scene.add(transformed(quad("light", {-0.75, 0.0, -0.5}, {1.5, 0.0, 0.0}, {0.0, 0.0, 1.0}), pose),
            light);
  scene.addCamera("floor", {0.0, 2.6, 4.6}, {0.0, 0.0, 0.2}, 36.0);
  return scene.finish();
}

}  // namespace restlab::builtin
