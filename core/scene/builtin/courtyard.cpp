// A square court within an arcade, under a clear sky: sun (a directional light) and sky (an
// environment map). The camera stands in the corridor, where all light except a few sunlit patches
// comes by way of the court. The bays are instances of one arch and one column.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/builtin/sky.h"

namespace restlab::builtin {
namespace {

constexpr int kBays = 6;
constexpr double kBay = 2.4;                     // metres between columns
constexpr double kHalf = 0.5 * kBays * kBay;     // half side of the court
constexpr double kDepth = 2.8;                   // depth of the corridor
constexpr double kSpring = 2.4, kRadius = 0.98;  // height where the arches start; their radius
constexpr double kTop = 4.2, kRoof = 4.6, kThick = 0.36;

// One bay of the arcade wall above the columns: x in -kBay/2..kBay/2, z in -kThick/2..kThick/2,
// y from the springing line to the top, with a half-round opening.
MeshGeometry archBay() {
  constexpr int segments = 24;
  const double h = 0.5 * kThick, side = 0.5 * kBay;
  MeshGeometry mesh;
  mesh.name = "arch";
  const auto arc = [&](int i, double z) {
    const double angle = glm::pi<double>() * (1.0 - double(i) / segments);
    return glm::dvec3(kRadius * std::cos(angle), kSpring + kRadius * std::sin(angle), z);
  };
  // Returns the point of the top edge that belongs to point i of the arc.
  const auto rim = [&](int i, double z) {
    return glm::dvec3(-side + 2.0 * side * double(i) / segments, kTop, z);
  };
  for (int i = 0; i < segments; ++i) {
    append(mesh, quads("", {arc(i, h), arc(i + 1, h), rim(i + 1, h), rim(i, h)}));
    append(mesh, quads("", {arc(i + 1, -h), arc(i, -h), rim(i, -h), rim(i + 1, -h)}));
    append(mesh, quads("", {arc(i, -h), arc(i + 1, -h), arc(i + 1, h), arc(i, h)}));
  }
  for (const double z : {h, -h}) {
    const glm::dvec3 springLeft(-side, kSpring, z), springRight(side, kSpring, z);
    MeshGeometry flanks;
    flanks.positions = {springLeft,       arc(0, z),   rim(0, z),
                        arc(segments, z), springRight, rim(segments, z)};
    flanks.triangles = {{0, 1, 2}, {3, 4, 5}};
    if (z < 0.0) {
      for (glm::uvec3& t : flanks.triangles) std::swap(t.y, t.z);
    }
    append(mesh, flanks);
  }
  for (const double x : {-side, kRadius}) {
    const double width = side - kRadius;
    append(mesh, quad("", {x, kSpring, -h}, {width, 0, 0}, {0, 0, 2.0 * h}));
  }
  return mesh;
}

MeshGeometry column() {
  MeshGeometry mesh = cylinder("column", {0.0, 0.30, 0.0}, 0.17, kSpring - 0.52, 40);
  append(mesh, cylinder("", {0.0, 0.14, 0.0}, 0.22, 0.158, 40));
  append(mesh, cylinder("", {0.0, kSpring - 0.218, 0.0}, 0.205, 0.07, 40));
  return mesh;
}

MeshGeometry columnBlocks() {
  MeshGeometry mesh = box("blocks", {-0.25, 0.001, -0.25}, {0.25, 0.139, 0.25});
  append(mesh, box("", {-0.22, kSpring - 0.147, -0.22}, {0.22, kSpring - 0.001, 0.22}));
  return mesh;
}

void addArcade(SceneBuilder& scene) {
  const uint32_t sandstone = scene.addMaterial("sandstone", lambert({0.66f, 0.53f, 0.38f}));
  const uint32_t marble = scene.addMaterial("marble", lambert({0.74f, 0.71f, 0.67f}));
  const uint32_t arch = scene.addGeometry(archBay());
  const uint32_t shaft = scene.addGeometry(column());
  const double side = 0.5 * kThick + 0.02;
  const uint32_t pier = scene.addGeometry(box("pier", {-side, kSpring, -side}, {side, kTop, side}));
  const uint32_t blocks = scene.addGeometry(columnBlocks());
  for (int wing = 0; wing < 4; ++wing) {
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1.0), 0.5 * glm::pi<double>() * wing, glm::dvec3(0, 1, 0));
    for (int bay = 0; bay < kBays; ++bay) {
      const std::string name = std::to_string(wing) + "-" + std::to_string(bay);
      const double x = -kHalf + (bay + 0.5) * kBay;
      scene.place("arch-" + name, arch, sandstone, glm::translate(turn, glm::dvec3(x, 0.0, kHalf)));
      const glm::dmat4 foot = glm::translate(turn, glm::dvec3(x - 0.5 * kBay, 0.0, kHalf));
      scene.place("column-" + name, shaft, marble, foot);
      scene.place("blocks-" + name, blocks, marble, foot);
    }
    // A pier closes the open ends of two wings.
    scene.place("pier-" + std::to_string(wing), pier, sandstone,
                glm::translate(turn, glm::dvec3(-kHalf, 0.0, kHalf)));
  }
}

// Floor, outer walls and the roof over the corridor: four boxes each, mitred by overlap-free
// lengths.
void addBuilding(SceneBuilder& scene) {
  const uint32_t ground = scene.addMaterial("gravel", lambert({0.42f, 0.38f, 0.32f}));
  const uint32_t paving = scene.addMaterial("paving", lambert({0.36f, 0.22f, 0.16f}));
  const uint32_t plaster = scene.addMaterial("plaster", lambert({0.72f, 0.64f, 0.52f}));
  const uint32_t tiles = scene.addMaterial("tiles", lambert({0.55f, 0.24f, 0.14f}));
  const uint32_t fresco = scene.addMaterial("fresco", lambert({0.16f, 0.30f, 0.50f}));
  const double eaves = kHalf - 0.35;  // the roof hides the open top of the arches
  const double inner = kHalf - 0.3, outer = kHalf + kDepth, edge = outer + 0.4;
  scene.add(quad("court", {-inner, 0.0, inner}, {2 * inner, 0, 0}, {0, 0, -2 * inner}), ground);
  scene.add(quad("outside", {-40.0, -0.3, 40.0}, {80, 0, 0}, {0, 0, -80}), ground);
  MeshGeometry floor, wall, roof, panels;
  floor.name = "corridor-floor";
  wall.name = "outer-wall";
  roof.name = "roof";
  panels.name = "frescoes";
  for (int wing = 0; wing < 4; ++wing) {
    // Each wing covers one corner, so that the four close the square without overlap.
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1.0), 0.5 * glm::pi<double>() * wing, glm::dvec3(0, 1, 0));
    append(floor, transformed(box("", {-inner, -0.3, inner}, {outer, 0.0, outer}), turn));
    append(wall, transformed(box("", {-outer, -0.3, outer}, {edge, kRoof, edge}), turn));
    append(roof, transformed(box("", {-eaves, kTop - 0.01, eaves}, {outer, kRoof, outer}), turn));
    for (int bay = 0; bay < kBays; bay += 2) {
      const double x = -kHalf + (bay + 0.5) * kBay;
      append(
          panels,
          transformed(box("", {x - 0.7, 1.0, outer - 0.03}, {x + 0.7, 2.6, outer - 0.001}), turn));
    }
  }
  scene.add(floor, paving);
  scene.add(wall, plaster);
  scene.add(roof, tiles);
  scene.add(panels, fresco);
  const uint32_t stone = scene.addMaterial("stone", lambert({0.60f, 0.58f, 0.54f}));
  scene.add(cylinder("basin", {0.0, 0.001, 0.0}, 1.6, 0.55, 64), stone);
  scene.add(sphere("finial", {0.0, 1.252, 0.0}, 0.7, 5), stone);
}

}  // namespace

Scene makeCourtyard() {
  SceneBuilder scene("courtyard");
  addBuilding(scene);
  addArcade(scene);
  const Sky sky;
  scene.setEnvironment(skyMap(sky, 512, 256));
  PunctualLight sun;
  sun.name = "sun";
  sun.kind = rl::RL_LIGHT_DIRECTIONAL;
  sun.dirW = -sky.towardsSun;
  sun.intensity = {11.0f, 9.6f,
                   7.6f};  // W/m^2 on a plane across the rays: some four times the sky's
  scene.addLight(sun);
  scene.addCamera("corridor", {-kHalf - 1.9, 1.65, kHalf + 1.6}, {-kHalf + 1.2, 1.75, -2.0}, 58.0);
  return scene.finish();
}

}  // namespace restlab::builtin
