// A glossy gallery: rows of metal and plastic spheres whose roughness runs from 0.05 to 0.8, tilted
// plates before the back wall, coloured walls, a floor with sheen, and five area lights whose sizes
// span two decades: each light asks for another balance of light and BSDF samples.
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/builtin/shell.h"

namespace restlab::builtin {
namespace {

constexpr std::array<float, 6> kRoughness{0.05f, 0.12f, 0.2f, 0.35f, 0.55f, 0.8f};
constexpr double kHalfWidth = 5.0, kHeight = 4.0, kBack = -5.0, kFront = 6.0;

std::string percent(float roughness) { return std::to_string(int(roughness * 100.0f + 0.5f)); }

void addRoom(SceneBuilder& scene) {
  ShellGrid grid;
  grid.lines = {{{-kHalfWidth, kHalfWidth}, {0.0, kHeight}, {kBack, kFront}}};
  grid.isAir = [](const glm::dvec3&) { return true; };
  grid.groupOf = [](const glm::dvec3&, const glm::dvec3& normal) -> uint32_t {
    if (normal.y > 0.5) return 0;
    if (normal.y < -0.5) return 1;
    if (normal.x > 0.5) return 2;
    return normal.x < -0.5 ? 3 : 4;
  };
  const std::array<rl::Material, 5> materials{
      plastic({0.25f, 0.22f, 0.20f}, 0.3f), lambert({0.75f, 0.75f, 0.75f}),
      lambert({0.60f, 0.16f, 0.12f}), lambert({0.12f, 0.32f, 0.50f}),
      lambert({0.55f, 0.50f, 0.42f})};
  const std::vector<MeshGeometry> shell =
      airShell("room", grid, {"floor", "ceiling", "left", "right", "ends"});
  for (size_t i = 0; i < shell.size(); ++i)
    scene.add(shell[i], scene.addMaterial(shell[i].name, materials[i]));
}

// Adds pairs of spheres of one roughness on pedestals, metal in front and plastic behind.
void addSpheres(SceneBuilder& scene) {
  const std::array<glm::vec3, 3> metals{
      {{1.00f, 0.77f, 0.34f}, {0.95f, 0.64f, 0.54f}, {0.91f, 0.92f, 0.92f}}};
  const std::array<glm::vec3, 3> paints{
      {{0.55f, 0.05f, 0.05f}, {0.05f, 0.30f, 0.10f}, {0.06f, 0.10f, 0.45f}}};
  MeshGeometry pedestals;
  pedestals.name = "pedestals";
  for (size_t i = 0; i < kRoughness.size(); ++i) {
    const double x = -2.5 + 1.0 * double(i);
    append(pedestals, box("", {x - 0.3, 0.001, 0.2}, {x + 0.3, 0.5, 0.8}));
    append(pedestals, box("", {x - 0.3, 0.001, -1.4}, {x + 0.3, 1.1, -0.8}));
    const uint32_t front =
        scene.addMaterial("metal-" + percent(kRoughness[i]), metal(metals[i % 3], kRoughness[i]));
    scene.add(sphere("metal-sphere-" + percent(kRoughness[i]), {x, 0.901, 0.5}, 0.40, 5), front);
    const uint32_t behind = scene.addMaterial("plastic-" + percent(kRoughness[i]),
                                              plastic(paints[i % 3], kRoughness[i]));
    scene.add(sphere("plastic-sphere-" + percent(kRoughness[i]), {x, 1.501, -1.1}, 0.40, 5),
              behind);
  }
  scene.add(pedestals, scene.addMaterial("pedestal", lambert({0.6f, 0.6f, 0.6f})));
}

// Adds five steel plates leaning back by the same angle, smooth on the left, rough on the right.
void addPlates(SceneBuilder& scene) {
  for (int i = 0; i < 5; ++i) {
    const float roughness = kRoughness[size_t(i)];
    const double x = -3.6 + 1.45 * i;
    glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.45, -3.4));
    pose = glm::rotate(pose, glm::radians(-16.0), glm::dvec3(1.0, 0.0, 0.0));
    const uint32_t steel =
        scene.addMaterial("steel-" + percent(roughness), metal({0.66f, 0.65f, 0.63f}, roughness));
    scene.add(
        transformed(box("plate-" + percent(roughness), {0.0, 0.0, 0.0}, {1.3, 2.4, 0.05}), pose),
        steel);
  }
}

void addLights(SceneBuilder& scene) {
  const double y = kHeight - 0.05;
  const auto panel = [&](const std::string& name, double x, double z, double side,
                         const glm::vec3& radiance) {
    const glm::dvec3 corner(x - 0.5 * side, y, z - 0.5 * side);
    scene.add(quad(name, corner, {side, 0.0, 0.0}, {0.0, 0.0, side}),
              scene.addMaterial(name, lamp(radiance)));
  };
  panel("light-large", 0.0, 2.6, 2.0, {8.0f, 7.7f, 7.0f});
  panel("light-left", -3.2, -0.2, 0.8, {36.0f, 26.0f, 15.0f});
  panel("light-right", 3.2, -0.2, 0.8, {15.0f, 24.0f, 36.0f});
  panel("light-small", -1.2, 0.2, 0.25, {220.0f, 205.0f, 180.0f});
  panel("light-spark", 1.4, 0.1, 0.15, {400.0f, 345.0f, 265.0f});
}

}  // namespace

Scene makeGlossyGallery() {
  SceneBuilder scene("glossy-gallery");
  addRoom(scene);
  addSpheres(scene);
  addPlates(scene);
  addLights(scene);
  scene.addCamera("visitor", {0.0, 2.1, 5.8}, {0.0, 1.35, -1.5}, 45.0);
  return scene.finish();
}

}  // namespace restlab::builtin
