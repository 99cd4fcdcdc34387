// Glass in a small lit room: clear, frosted and tinted spheres and slabs, a plain mirror on the
// back wall. Solids hang a millimetre above their supports, so that no two faces coincide.
#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/builtin/shell.h"

namespace restlab::builtin {
namespace {

constexpr double kHalfPanel = 0.6;  // half side of the ceiling light, metres

void addGlassRoom(SceneBuilder& scene) {
  ShellGrid grid;
  grid.lines = {
      {{-2.0, -kHalfPanel, kHalfPanel, 2.0}, {0.0, 2.6}, {-2.0, -kHalfPanel, kHalfPanel, 3.0}}};
  grid.isAir = [](const glm::dvec3&) { return true; };
  grid.groupOf = [](const glm::dvec3& center, const glm::dvec3& normal) -> uint32_t {
    if (normal.y < -0.5)
      return std::max(std::abs(center.x), std::abs(center.z)) < kHalfPanel ? 4 : 0;
    if (normal.y > 0.5) return 3;
    if (normal.x > 0.5) return 1;
    return normal.x < -0.5 ? 2 : 0;
  };
  const std::vector<MeshGeometry> shell =
      airShell("room", grid, {"white", "orange", "teal", "floor", "light"});
  const rl::Material materials[5] = {lambert({0.74f, 0.73f, 0.70f}), lambert({0.70f, 0.33f, 0.10f}),
                                     lambert({0.10f, 0.42f, 0.42f}), lambert({0.45f, 0.42f, 0.38f}),
                                     lamp({9.0f, 8.6f, 8.0f})};
  for (size_t i = 0; i < shell.size(); ++i)
    scene.add(shell[i], scene.addMaterial(shell[i].name, materials[i]));
}

}  // namespace

Scene makeGlass() {
  SceneBuilder scene("glass");
  addGlassRoom(scene);
  const glm::vec3 clearSigma(0.0f);
  const uint32_t clear = scene.addMaterial("clear", glass(0.0f, clearSigma));
  const uint32_t frosted = scene.addMaterial("frosted", glass(0.55f, clearSigma));
  const uint32_t satin = scene.addMaterial("satin", glass(0.30f, clearSigma));
  const uint32_t amber = scene.addMaterial("amber", glass(0.0f, {0.35f, 1.6f, 5.0f}));
  const uint32_t bottle = scene.addMaterial("bottle", glass(0.0f, {4.0f, 0.5f, 2.4f}));
  const uint32_t cobalt = scene.addMaterial("cobalt", glass(0.25f, {6.0f, 3.0f, 0.3f}));
  const uint32_t mirror = scene.addMaterial("mirror", metal({0.92f, 0.92f, 0.92f}, 0.0f));
  const uint32_t plinth = scene.addMaterial("plinth", lambert({0.55f, 0.52f, 0.50f}));

  scene.add(box("mirror", {-1.5, 0.5, -1.98}, {0.6, 2.2, -1.94}), mirror);
  scene.add(box("plinth", {-1.6, 0.001, -1.2}, {1.6, 0.40, -0.4}), plinth);
  scene.add(sphere("clear-sphere", {-1.1, 0.801, -0.8}, 0.40, 5), clear);
  scene.add(sphere("amber-sphere", {0.0, 0.801, -0.8}, 0.40, 5), amber);
  scene.add(sphere("frosted-sphere", {1.1, 0.801, -0.8}, 0.40, 5), frosted);
  scene.add(transformed(box("bottle-slab", {-1.35, 0.001, 0.25}, {-0.65, 0.75, 0.45}),
                        turnAbout({-1.0, 0.0, 0.35}, 25.0)),
            bottle);
  scene.add(transformed(box("satin-slab", {0.75, 0.001, 0.35}, {1.35, 0.95, 0.47}),
                        turnAbout({1.05, 0.0, 0.41}, -30.0)),
            satin);
  scene.add(sphere("cobalt-sphere", {-0.05, 0.251, 0.45}, 0.25, 5), cobalt);
  scene.add(sphere("marble", {0.50, 0.131, 0.80}, 0.13, 5), clear);
  scene.addCamera("window", {0.35, 1.45, 2.85}, {0.0, 0.85, -0.6}, 48.0);
  return scene.finish();
}

}  // namespace restlab::builtin
