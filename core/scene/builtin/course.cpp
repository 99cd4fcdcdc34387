// One scene for all light of a lighting course: a lamp, matte walls and a block, a ball of glass
// and a mirror ball. `figure --series course` shows it light by light.
#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/builtin/shell.h"

namespace restlab::builtin {
namespace {

constexpr double kHalfLamp = 0.5;  // half side of the lamp in the ceiling, metres

void addCourseRoom(SceneBuilder& scene) {
  ShellGrid grid;
  grid.lines = {
      {{-2.0, -kHalfLamp, kHalfLamp, 2.0}, {0.0, 3.0}, {-2.0, -kHalfLamp, kHalfLamp, 3.5}}};
  grid.isAir = [](const glm::dvec3&) { return true; };
  grid.groupOf = [](const glm::dvec3& center, const glm::dvec3& normal) -> uint32_t {
    if (normal.y < -0.5)
      return std::max(std::abs(center.x), std::abs(center.z)) < kHalfLamp ? 4 : 0;
    if (normal.y > 0.5) return 3;
    if (normal.x > 0.5) return 1;
    return normal.x < -0.5 ? 2 : 0;
  };
  const std::vector<MeshGeometry> shell =
      airShell("room", grid, {"white", "blue", "yellow", "floor", "lamp"});
  const rl::Material materials[5] = {lambert({0.73f, 0.73f, 0.72f}), lambert({0.10f, 0.20f, 0.55f}),
                                     lambert({0.65f, 0.50f, 0.10f}), lambert({0.50f, 0.48f, 0.45f}),
                                     lamp({13.0f, 12.0f, 10.5f})};
  for (size_t i = 0; i < shell.size(); ++i)
    scene.add(shell[i], scene.addMaterial(shell[i].name, materials[i]));
}

}  // namespace

Scene makeCourse() {
  SceneBuilder scene("course");
  addCourseRoom(scene);
  const uint32_t clear = scene.addMaterial("glass", glass(0.0f, glm::vec3(0.0f)));
  const uint32_t mirror = scene.addMaterial("mirror", metal({0.95f, 0.94f, 0.92f}, 0.0f));
  const uint32_t matte = scene.addMaterial("matte", lambert({0.60f, 0.25f, 0.15f}));
  // A millimetre above the floor, so that no two faces coincide.
  scene.add(transformed(box("block", {-0.45, 0.001, -0.45}, {0.45, 1.3, 0.45}),
                        glm::translate(glm::dmat4(1.0), {0.0, 0.0, -0.9}) *
                            turnAbout({0.0, 0.0, 0.0}, 25.0)),
            matte);
  scene.add(sphere("glass-ball", {0.95, 0.501, 0.5}, 0.5, 5), clear);
  scene.add(sphere("mirror-ball", {-1.05, 0.551, 0.1}, 0.55, 5), mirror);
  scene.addCamera("class", {0.0, 1.5, 3.45}, {0.0, 1.42, 0.0}, 62.0);
  return scene.finish();
}

}  // namespace restlab::builtin
