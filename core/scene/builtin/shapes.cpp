// Scenes of shapes beside triangles: a gallery, a furnace for each shape, a ball in several
// representations.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/shapes/fine_meshes.h"
#include "core/scene/splines/tessellate.h"

namespace restlab::builtin {

namespace {

// Takes the z axis of a shape's own space upwards.
const glm::dmat4 kUpright =
    glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));

// Moves a box to the origin, its largest side `size` long: standing on it or around it.
glm::dmat4 fitted(const ShapeGeometry& shape, double size, bool isStanding) {
  const std::array<glm::vec3, 2> box = shape.info->box(shape);
  const glm::dvec3 low(box[0]), high(box[1]), extent = high - low;
  glm::dvec3 anchor = 0.5 * (low + high);
  if (isStanding) anchor.z = low.z;
  const double factor = size / std::max({extent.x, extent.y, extent.z});
  return glm::scale(glm::dmat4(1.0), glm::dvec3(factor)) * glm::translate(glm::dmat4(1.0), -anchor);
}

ShapeGeometry plainShape(const char* kind) {
  const ShapeInfo* info = findShape(kind);
  ShapeGeometry shape{info, {}};
  for (const ShapeParameter& p : info->parameters) shape.values.push_back(float(p.fallback));
  return shape;
}

void placeShape(SceneBuilder& scene, const std::string& name, const ShapeGeometry& shape,
                const rl::Material& material, const glm::dmat4& toWorld) {
  const uint32_t id = scene.addMaterial(name, material);
  scene.place(name, scene.addGeometry(makeShape(shape, name)), id, toWorld);
}

// Adds a floor around (0, 0, z), and a lamp above it that looks down.
void addStage(SceneBuilder& scene, double halfSize, double height, double lampSide, float radiance,
              double z) {
  const ShapeGeometry square = plainShape("rectangle");
  placeShape(scene, "floor", square, lambert({0.55f, 0.53f, 0.5f}),
             glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, z)) * kUpright *
                 glm::scale(glm::dmat4(1.0), glm::dvec3(halfSize)));
  glm::dmat4 above = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, height, z + 1.0));
  above = glm::rotate(above, glm::radians(90.0), glm::dvec3(1.0, 0.0, 0.0));
  placeShape(scene, "lamp", square, lamp(glm::vec3(radiance)),
             glm::scale(above, glm::dvec3(0.5 * lampSide)));
}

// Triangles of the sphere as a surface of control points, within 1e-4 of it.
MeshGeometry ballOfNurbs() {
  const BezierGrid grid = bezierGrid(sphereAsNurbs());
  return tessellate(grid, gridCells(grid, [](const BezierPiece& piece) {
                      return cellsFor(piece, 1e-4).value();
                    }));
}

// Indices into namedShapes() of what is the unit sphere.
std::vector<size_t> unitSpheres() {
  std::vector<size_t> found;
  const std::string end = "_sphere";
  for (size_t i = 0; i < namedShapes().size(); ++i) {
    const std::string& name = namedShapes()[i].name;
    const bool isExample =
        name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    if (name == "sphere" || isExample) found.push_back(i);
  }
  return found;
}

}  // namespace

Scene makeShapes() {
  SceneBuilder scene("shapes");
  const std::array<rl::Material, 4> looks{
      lambert({0.65f, 0.25f, 0.18f}), metal({1.0f, 0.77f, 0.34f}, 0.25f),
      plastic({0.08f, 0.25f, 0.5f}, 0.15f), lambert({0.3f, 0.5f, 0.25f})};
  constexpr size_t kColumns = 5;
  constexpr double kSpacing = 2.0;
  size_t placed = 0;
  for (const NamedShape& named : namedShapes()) {
    const double x = (double(placed % kColumns) - 0.5 * (kColumns - 1)) * kSpacing;
    const double z = -kSpacing * double(placed / kColumns);
    const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.001, z)),
                                         glm::radians(25.0), glm::dvec3(0.0, 1.0, 0.0));
    const bool isFlat = named.shape.info->isFlat;  // leans, as it would vanish in the floor
    const glm::dmat4 lean =
        isFlat ? glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.65, 0.0)),
                             glm::radians(55.0), glm::dvec3(1.0, 0.0, 0.0))
               : glm::dmat4(1.0);
    placeShape(scene, named.name, named.shape, looks[placed % looks.size()],
               place * lean * kUpright * fitted(named.shape, 1.4, !isFlat));
    ++placed;
  }
  const double rows = std::ceil(double(placed) / double(kColumns));
  const double depth = kSpacing * rows + 8.0, middle = 6.0 - 0.5 * depth;
  addStage(scene, 0.5 * depth, 6.0, 3.0, 22.0f, middle);
  const ShapeGeometry square = plainShape("rectangle");
  const auto wall = [&](const char* name, const glm::dvec3& centre, double degrees,
                        const glm::vec3& albedo) {
    glm::dmat4 m = glm::rotate(glm::translate(glm::dmat4(1.0), centre), glm::radians(degrees),
                               glm::dvec3(0.0, 1.0, 0.0));
    placeShape(scene, name, square, lambert(albedo),
               glm::scale(m, glm::dvec3(0.5 * depth, 4.0, 1.0)));
  };
  wall("back", {0.0, 4.0, middle - 0.5 * depth}, 0.0, {0.6f, 0.6f, 0.6f});
  wall("left", {-0.5 * depth, 4.0, middle}, 90.0, {0.6f, 0.3f, 0.2f});
  wall("right", {0.5 * depth, 4.0, middle}, -90.0, {0.2f, 0.35f, 0.55f});
  placeShape(
      scene, "glowing sphere", plainShape("sphere"), lamp({9.0f, 6.0f, 3.0f}),
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, 0.3, 1.4)), glm::dvec3(0.3)));
  scene.addCamera("visitor", {0.0, 2.4 + 0.8 * rows, 6.5},
                  {0.0, 0.6, -0.5 * kSpacing * (rows - 1.0)}, 42.0);
  return scene.finish();
}

// All surfaces have albedo 1/2 and emit 1/2, on both sides, and light of radiance 1 arrives from
// where no surface is: radiance is 1 at every pixel, less what is behind the last scattering event.
Scene makeShapeFurnace(const NamedShape& shape, bool isMesh) {
  SceneBuilder scene("shape-furnace");
  rl::Material glowing = lambert(glm::vec3(0.5f));
  glowing.emission = glm::vec3(0.5f);
  const glm::dmat4 place = kUpright * fitted(shape.shape, 2.0, false);
  if (isMesh) {
    const uint32_t material = scene.addMaterial(shape.name, glowing);
    scene.place(shape.name, scene.addGeometry(fineMesh(shape.shape)), material, place);
  } else {
    placeShape(scene, shape.name, shape.shape, glowing, place);
  }
  scene.setEnvironment(uniformEnvironment());
  scene.addCamera("front", {0.3, 0.9, 3.0}, {0.0, 0.0, 0.0}, 45.0);
  scene.addCamera("inside", {0.05, 0.1, 0.02}, {0.4, 0.3, -0.5}, 90.0);
  return scene.finish();
}

const std::vector<std::string>& sphereRepresentations() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const size_t i : unitSpheres()) names.push_back(namedShapes()[i].name);
    names.push_back("nurbs_mesh");
    names.push_back("mesh");
    return names;
  }();
  return kNames;
}

Scene makeBall(size_t representation) {
  SceneBuilder scene("ball");
  addStage(scene, 12.0, 4.0, 1.6, 16.0f, 0.0);
  const rl::Material lacquer = plastic({0.5f, 0.12f, 0.08f}, 0.3f);
  const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1.001, 0.0)) * kUpright;
  const std::vector<size_t> spheres = unitSpheres();
  if (representation < spheres.size()) {
    placeShape(scene, "ball", namedShapes()[spheres[representation]].shape, lacquer, place);
  } else {
    const uint32_t material = scene.addMaterial("ball", lacquer);
    const bool isOfNurbs = sphereRepresentations().at(representation) == "nurbs_mesh";
    MeshGeometry mesh = isOfNurbs ? ballOfNurbs() : sphere("ball", glm::dvec3(0.0), 1.0, 6);
    mesh.name = "ball";
    scene.place("ball", scene.addGeometry(std::move(mesh)), material, place);
  }
  scene.addCamera("front", {0.0, 1.8, 4.6}, {0.0, 0.8, 0.0}, 45.0);
  return scene.finish();
}

}  // namespace restlab::builtin
