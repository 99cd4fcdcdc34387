// Two rooms and a door ajar. A ceiling panel lights the far room; the near one, where the camera
// stands, gets the light that passes the gap of 30 cm between the door's edge and its jamb. No
// pixel sees the panel: only a narrow strip of wall and floor is lit directly, everything else by
// two or more scattering events.
//
// Near room 5.0 x 2.7 x 5.0 m (x -2.5..2.5, z 0..5), wall of 15 cm with the doorway, far room 5.0 x
// 2.7 x 3.5 m. Everything is Lambert. The shell of both rooms and doorway is one closed surface.
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/builtin/shell.h"

namespace restlab::builtin {
namespace {

constexpr double kWallNear = 0.0, kWallFar = -0.15;  // faces of the wall between, z
constexpr double kDoorLeft = 0.5, kDoorRight = 1.4, kDoorTop = 2.05;
constexpr double kDoorWidth = 0.89, kDoorThickness = 0.04, kGap = 0.30;
constexpr double kPanelX0 = -0.6, kPanelX1 = 0.8, kPanelZ0 = -2.1, kPanelZ1 = -1.1;

enum Group : uint32_t { kPlaster, kTerracotta, kBlue, kOak, kCeiling, kFarWall, kPanel, kGroups };

uint32_t shellGroup(const glm::dvec3& center, const glm::dvec3& normal) {
  const bool isFar = center.z < kWallFar;
  if (normal.y < -0.5) {
    const bool isPanel =
        center.x > kPanelX0 && center.x < kPanelX1 && center.z > kPanelZ0 && center.z < kPanelZ1;
    return isPanel ? kPanel : kCeiling;
  }
  if (normal.y > 0.5) return kOak;
  if (isFar) return kFarWall;
  if (center.x < -2.4) return kTerracotta;
  return center.x > 2.4 ? kBlue : kPlaster;
}

void addShell(SceneBuilder& scene) {
  ShellGrid grid;
  grid.lines = {{{-2.5, kPanelX0, kDoorLeft, kPanelX1, kDoorRight, 2.5},
                 {0.0, kDoorTop, 2.7},
                 {-3.65, kPanelZ0, kPanelZ1, kWallFar, kWallNear, 5.0}}};
  grid.isAir = [](const glm::dvec3& p) {
    if (p.z > kWallNear || p.z < kWallFar) return true;
    return p.x > kDoorLeft && p.x < kDoorRight && p.y < kDoorTop;
  };
  grid.groupOf = shellGroup;
  const std::vector<MeshGeometry> shell = airShell(
      "shell", grid, {"plaster", "terracotta", "blue", "oak", "ceiling", "far-wall", "panel"});
  const rl::Material materials[kGroups] = {
      lambert({0.70f, 0.66f, 0.58f}), lambert({0.68f, 0.25f, 0.14f}),
      lambert({0.18f, 0.34f, 0.58f}), lambert({0.46f, 0.30f, 0.17f}),
      lambert({0.78f, 0.78f, 0.76f}), lambert({0.76f, 0.70f, 0.60f}),
      lamp({900.0f, 760.0f, 560.0f})};
  for (uint32_t g = 0; g < kGroups; ++g) {
    scene.add(shell[g], scene.addMaterial(shell[g].name.substr(6), materials[g]));
  }
}

// Adds the door: hinged on the left, opening into the near room until its free edge is kGap from
// the jamb.
void addDoor(SceneBuilder& scene) {
  const glm::dvec3 hinge(kDoorLeft - 0.001, 0.0, kWallNear);  // no slit on this side
  // Law of cosines in the triangle of hinge, free edge and jamb.
  const double jamb = kDoorRight - hinge.x;
  const double cosine =
      (kDoorWidth * kDoorWidth + jamb * jamb - kGap * kGap) / (2.0 * kDoorWidth * jamb);
  const double angle = -glm::degrees(std::acos(cosine));
  const glm::dmat4 swing = turnAbout(hinge, angle);
  const uint32_t wood = scene.addMaterial("door", lambert({0.62f, 0.56f, 0.44f}));
  const glm::dvec3 low(hinge.x, 0.008, kWallNear),
      high(hinge.x + kDoorWidth, kDoorTop - 0.005, kWallNear + kDoorThickness);
  scene.add(transformed(box("door", low, high), swing), wood);
  const uint32_t brass = scene.addMaterial("handle", lambert({0.75f, 0.55f, 0.20f}));
  const glm::dvec3 knob(high.x - 0.07, 1.02, high.z + 0.035);
  scene.add(transformed(sphere("handle", knob, 0.035, 3), swing), brass);
}

void addFurniture(SceneBuilder& scene) {
  const uint32_t walnut = scene.addMaterial("walnut", lambert({0.30f, 0.17f, 0.09f}));
  const uint32_t cloth = scene.addMaterial("cloth", lambert({0.20f, 0.42f, 0.24f}));
  const uint32_t white = scene.addMaterial("porcelain", lambert({0.80f, 0.80f, 0.78f}));
  const uint32_t yellow = scene.addMaterial("yellow", lambert({0.80f, 0.58f, 0.10f}));
  const uint32_t rug = scene.addMaterial("rug", lambert({0.50f, 0.10f, 0.12f}));

  scene.add(box("rug", {-1.3, 0.002, 1.2}, {1.0, 0.014, 3.0}), rug);
  MeshGeometry table = box("table", {-0.75, 0.42, 1.65}, {0.45, 0.46, 2.45});
  for (const double x : {-0.72, 0.36}) {
    for (const double z : {1.68, 2.36}) {
      append(table, box("leg", {x, 0.016, z}, {x + 0.06, 0.419, z + 0.06}));
    }
  }
  scene.add(table, walnut);
  scene.add(sphere("bowl", {-0.40, 0.592, 2.05}, 0.13, 4), white);
  scene.add(sphere("lemon", {0.12, 0.532, 1.88}, 0.07, 4), yellow);
  scene.add(transformed(box("book", {-0.02, 0.461, 2.12}, {0.20, 0.50, 2.30}),
                        turnAbout({0.1, 0.0, 2.2}, 24.0)),
            rug);

  MeshGeometry sofa = box("sofa", {-2.38, 0.06, 1.0}, {-1.55, 0.40, 3.1});
  append(sofa, box("back", {-2.38, 0.402, 1.0}, {-2.14, 0.85, 3.1}));
  append(sofa, box("arm", {-2.138, 0.402, 1.0}, {-1.55, 0.60, 1.22}));
  append(sofa, box("arm", {-2.138, 0.402, 2.88}, {-1.55, 0.60, 3.1}));
  scene.add(sofa, cloth);

  // A shelf left of the door, with things on it.
  MeshGeometry shelf = box("shelf", {-1.9, 0.002, 0.02}, {-1.87, 1.8, 0.34});
  append(shelf, box("side", {-0.73, 0.002, 0.02}, {-0.70, 1.8, 0.34}));
  for (const double y : {0.10, 0.65, 1.20, 1.77}) {
    append(shelf, box("board", {-1.868, y, 0.02}, {-0.732, y + 0.03, 0.34}));
  }
  scene.add(shelf, walnut);
  scene.add(sphere("vase", {-1.5, 0.801, 0.18}, 0.12, 4), white);
  scene.add(box("crate", {-1.25, 0.681, 0.06}, {-0.85, 0.98, 0.30}), yellow);
  MeshGeometry books = box("books", {-1.80, 1.231, 0.06}, {-1.74, 1.52, 0.28});
  for (int i = 1; i < 9; ++i) {
    const double x = -1.80 + 0.068 * i, top = 1.46 + 0.02 * ((i * 5) % 7);
    append(books, box("book", {x, 1.231, 0.06}, {x + 0.06, top, 0.28}));
  }
  scene.add(books, cloth);
  scene.add(box("picture", {2.46, 1.25, 2.3}, {2.498, 1.95, 3.3}), yellow);
  scene.add(cylinder("stool", {1.55, 0.001, 2.55}, 0.20, 0.46, 32), white);
}

}  // namespace

Scene makeDoorAjar() {
  SceneBuilder scene("door-ajar");
  addShell(scene);
  addDoor(scene);
  addFurniture(scene);
  scene.addCamera("room", {-1.15, 1.55, 4.85}, {0.80, 0.98, 0.0}, 52.0);
  return scene.finish();
}

}  // namespace restlab::builtin
