// The Cornell box from its published measurements (Cornell Program of Computer Graphics:
// millimetres, x to the left, z into the box). Coordinates are divided by 100, which makes a room
// of 5.5 m out of the box of 55 cm, and turned by half a turn about y, (x, y, z) -> (-x, y, -z) /
// 100, which keeps the windings.
//
// The light is black and fills a hole in the ceiling: one- and two-sided emitters then agree. The
// left wall is not planar, so everything is flat-shaded: each triangle has its own normal.
// Mean radiance of 512x512 pixels at 8 scattering events: 0.19590, 0.12730, 0.03641.
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"

namespace restlab::builtin {
namespace {

// Makes quads from corners in the published frame.
MeshGeometry measured(const std::string& name, std::vector<glm::dvec3> corners) {
  for (glm::dvec3& p : corners) p = glm::dvec3(-p.x, p.y, -p.z) / 100.0;
  return quads(name, corners);
}

}  // namespace

Scene makeCornellBox() {
  SceneBuilder scene("cornell-box");
  const uint32_t white = scene.addMaterial("White", lambert({0.725f, 0.71f, 0.68f}));
  const uint32_t red = scene.addMaterial("Red", lambert({0.63f, 0.065f, 0.05f}));
  const uint32_t green = scene.addMaterial("Green", lambert({0.14f, 0.45f, 0.091f}));
  const uint32_t light = scene.addMaterial("Light", lamp({17.0f, 12.0f, 4.0f}));

  // clang-format off: a row is a face
  scene.add(measured("Floor", {{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}}), white);
  // Four strips around the hole of the light.
  scene.add(measured("Ceiling", {{556, 548.8, 0},
                                 {556, 548.8, 227},
                                 {0, 548.8, 227},
                                 {0, 548.8, 0},
                                 {556, 548.8, 332},
                                 {556, 548.8, 559.2},
                                 {0, 548.8, 559.2},
                                 {0, 548.8, 332},
                                 {213, 548.8, 227},
                                 {213, 548.8, 332},
                                 {0, 548.8, 332},
                                 {0, 548.8, 227},
                                 {556, 548.8, 227},
                                 {556, 548.8, 332},
                                 {343, 548.8, 332},
                                 {343, 548.8, 227}}),
            white);
  scene.add(measured("BackWall",
                     {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}}),
            white);
  scene.add(measured("RightWall", {{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}}),
            green);
  scene.add(measured("LeftWall",
                     {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}}),
            red);
  scene.add(
      measured("ShortBlock",
               {{130, 165, 65},  {82, 165, 225},  {240, 165, 272}, {290, 165, 114}, {290, 0, 114},
                {290, 165, 114}, {240, 165, 272}, {240, 0, 272},   {130, 0, 65},    {130, 165, 65},
                {290, 165, 114}, {290, 0, 114},   {82, 0, 225},    {82, 165, 225},  {130, 165, 65},
                {130, 0, 65},    {240, 0, 272},   {240, 165, 272}, {82, 165, 225},  {82, 0, 225}}),
      white);
  scene.add(
      measured("TallBlock",
               {{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}, {423, 0, 247},
                {423, 330, 247}, {472, 330, 406}, {472, 0, 406},   {472, 0, 406},   {472, 330, 406},
                {314, 330, 456}, {314, 0, 456},   {314, 0, 456},   {314, 330, 456}, {265, 330, 296},
                {265, 0, 296},   {265, 0, 296},   {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}),
      white);
  scene.add(measured("Light",
                     {{343, 548.8, 227}, {343, 548.8, 332}, {213, 548.8, 332}, {213, 548.8, 227}}),
            light);
  // clang-format on
  scene.addCamera("Camera", {-2.78, 2.73, 8.0}, {-2.78, 2.73, 0.0}, 39.3077);
  return scene.finish();
}

}  // namespace restlab::builtin
