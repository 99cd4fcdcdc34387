// A Lambert floor under one rectangle, tilted and turned. The rectangle is black and the only other
// object, so the floor's radiance is albedo / pi times Lambert's polygon formula, exactly, from one
// scattering event on. The camera sees only floor, all of it in front of the rectangle's plane. A
// larger rectangle would stand between the floor and the first camera; the second camera, "low", is
// in front of its plane and sees the floor below any rectangle. A ground and a stray triangle are
// black and light nothing: they test methods that scale lights or coordinates by the size of the
// scene.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"

namespace restlab::builtin {

namespace {

// Removes the middle triangle from the mesh and returns it as a mesh of its own.
MeshGeometry takeOne(MeshGeometry& mesh, const std::string& name) {
  const size_t middle = mesh.triangles.size() / 2;
  MeshGeometry one;
  one.name = name;
  const glm::uvec3 corners = mesh.triangles[middle];
  for (int c = 0; c < 3; ++c) one.positions.push_back(mesh.positions[corners[c]]);
  one.triangles = {{0, 1, 2}};
  mesh.triangles.erase(mesh.triangles.begin() + std::ptrdiff_t(middle));
  return one;
}

}  // namespace

Scene makeQuadLight(const QuadLightShape& shape) {
  SceneBuilder scene("quad-light");
  const uint32_t floor = scene.addMaterial("floor", lambert({0.5f, 0.6f, 0.7f}));
  const uint32_t side = uint32_t(std::max(1.0, std::round(std::sqrt(0.5 * shape.triangles))));
  const double count = 2.0 * side * side;
  const glm::dvec3 mean = glm::dvec3(10.0, 8.0, 6.0) / (shape.edge * shape.edge);
  const glm::dvec3 others = mean * count / (count - 1.0 + shape.ratio);
  const uint32_t light = scene.addMaterial("light", lamp(glm::vec3(others)));
  scene.add(quad("floor", {-8.0, 0.0, 8.0}, {16.0, 0.0, 0.0}, {0.0, 0.0, -16.0}), floor);
  glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 2.0, -0.2));
  pose = glm::rotate(pose, glm::radians(25.0), glm::dvec3(0.0, 1.0, 0.0));
  pose = glm::rotate(pose, glm::radians(12.0), glm::dvec3(1.0, 0.0, 0.0));
  // u x v, the normal before the tilt, is -y.
  const glm::dvec3 u(1.5 * shape.edge, 0.0, 0.0), v(0.0, 0.0, shape.edge);
  MeshGeometry lamps = side == 1 ? quad("light", -0.5 * (u + v), u, v)
                                 : grid("light", -0.5 * (u + v), u, v, side, side);
  lamps = transformed(lamps, pose);
  if (shape.ratio != 1.0) {
    const uint32_t bright = scene.addMaterial("brightest", lamp(glm::vec3(others * shape.ratio)));
    scene.add(takeOne(lamps, "brightest"), bright);
  }
  scene.add(lamps, light);
  const auto black = [&] { return scene.addMaterial("black", lambert(glm::vec3(0.0f))); };
  if (shape.ground) {
    const double half = *shape.ground;
    scene.add(quad("ground", {-half, -1.0, half}, {2.0 * half, 0.0, 0.0}, {0.0, 0.0, -2.0 * half}),
              black());
    PunctualLight sun;
    sun.name = "sun below";
    sun.kind = rl::RL_LIGHT_DIRECTIONAL;
    sun.dirW = {0.0, 1.0, 0.0};
    sun.intensity = glm::vec3(100.0f);
    scene.addLight(sun);
  }
  if (shape.stray) {
    const double d = *shape.stray;
    scene.add(quad("stray", {d, d, d}, {0.0, 0.01 * d, 0.0}, {0.0, 0.0, 0.01 * d}), black());
  }
  scene.addCamera("floor", {0.0, 2.6, 4.6}, {0.0, 0.0, 0.2}, 36.0);
  scene.addCamera("low", {0.0, 0.9, 2.0}, {0.0, 0.0, 0.6}, 36.0);
  return scene.finish();
}

}  // namespace restlab::builtin
