// A white Lambert floor under a sky of radiance 1, with nothing on the floor. All light that the
// floor scatters comes straight from the sky: its radiance is 1 from any angle and for any
// triangulation, and the horizon is invisible. The parameters make the floor hard to render;
// experiments/truths/floor.cpp has the radiance for those that change it.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"

namespace restlab::builtin {

namespace {

constexpr double kEdge = 16.0;
constexpr uint32_t kSkyWidth = 1024, kSkyHeight = 512;
// Row of the sun in the map, 40 degrees off the zenith, and its column, to the left of the first
// camera.
constexpr uint32_t kSunRow = 114, kSunColumn = 200;

MeshGeometry cutFloor(const std::string& name, const FloorShape& shape) {
  const glm::dvec3 corner(-0.5 * kEdge, 0.0, 0.5 * kEdge), u(kEdge, 0.0, 0.0), v(0.0, 0.0, -kEdge);
  if (shape.needle > 1.0) return grid(name, corner, u, v, 1, uint32_t(std::lround(shape.needle)));
  if (shape.triangles == 1) {
    MeshGeometry one;  // contains the square
    one.name = name;
    one.positions = {glm::vec3(corner - u), glm::vec3(corner + 2.0 * u),
                     glm::vec3(corner + 0.5 * u + 2.0 * v)};
    one.triangles = {{0, 1, 2}};
    return one;
  }
  const uint32_t side = uint32_t(std::max(1.0, std::round(std::sqrt(0.5 * shape.triangles))));
  return grid(name, corner, u, v, side, side);
}

// Returns the same plane in other triangles.
MeshGeometry turnedFloor(const std::string& name, const FloorShape& shape) {
  return transformed(cutFloor(name, shape), turnAbout({0.0, 0.0, 0.0}, 90.0));
}

EnvironmentMap skyWithSun(double sun) {
  EnvironmentMap sky;
  sky.width = sun == 1.0 ? 16 : kSkyWidth;
  sky.height = sun == 1.0 ? 8 : kSkyHeight;
  sky.source = "uniform radiance 1";
  sky.radiance.assign(size_t(sky.width) * sky.height, glm::vec3(1.0f));
  if (sun == 1.0) return sky;
  sky.source += ", one pixel brighter";
  sky.radiance[size_t(kSunRow) * sky.width + kSunColumn] = glm::vec3(float(sun));
  return sky;
}

// Adds a normal map of one texel that tilts the normal sideways by `slope` degrees.
void lean(Scene& scene, double slope) {
  scene.images.push_back({"lean", 1, 1, {0xffff80ffu}});  // x 1, y 0.004, z 1
  TextureUse use;
  use.image = 0;
  scene.textureUses.push_back(use);
  rl::Material& material = scene.materials.at(0).data;
  material.textures[rl::RL_TEX_NORMAL] = 0;
  material.normalScale = float(std::tan(glm::radians(slope)));
  for (MeshGeometry& geometry : scene.geometries) {
    for (const glm::vec3& p : geometry.positions) geometry.uvs[0].emplace_back(p.x, -p.z);
  }
}

// Adds spots that shine down from a disc, spread as evenly as the seeds of a sunflower. Their total
// power does not depend on their number.
void addSpots(SceneBuilder& scene, uint32_t count) {
  constexpr double kHeight = 2.0, kDiskRadius = 4.0, kIntensity = 24.0;
  const double goldenAngle = glm::pi<double>() * (3.0 - std::sqrt(5.0));
  for (uint32_t i = 0; i < count; ++i) {
    const double r = kDiskRadius * std::sqrt((i + 0.5) / count), angle = goldenAngle * i;
    PunctualLight spot;
    spot.name = "spot " + std::to_string(i);
    spot.kind = rl::RL_LIGHT_SPOT;
    spot.posW = {r * std::cos(angle), kHeight, r * std::sin(angle)};
    spot.dirW = {0.0, -1.0, 0.0};
    spot.intensity = glm::vec3(float(kIntensity / count));
    spot.innerConeAngle = 0.0f;
    spot.outerConeAngle = glm::radians(70.0f);
    scene.addLight(spot);
  }
}

// Adds a slab of glass. Light that enters through one face leaves through the same or the opposite
// face, so no light is trapped as in a polyhedron: at an index of refraction of 3, a sphere of 5120
// faces still holds 0.3 % of an image's light after 64 events.
void addSlab(SceneBuilder& scene, double ior) {
  rl::Material material = glass(0.0f, glm::vec3(0.0f));
  material.ior = float(ior);
  const double half = 0.5 * kEdge;
  scene.add(box("floor", {-half, -1.0, -half}, {half, 0.0, half}),
            scene.addMaterial("glass", material));
}

void addFloors(SceneBuilder& scene, const FloorShape& shape) {
  const uint32_t white = scene.addMaterial("white", lambert(glm::vec3(1.0f)));
  for (uint32_t copy = 0; copy < shape.copies && shape.triangles > 0; ++copy) {
    const std::string name = copy == 0 ? "floor" : "floor " + std::to_string(copy + 1);
    scene.add(copy < 2 ? cutFloor(name, shape) : turnedFloor(name, shape), white);
  }
}

}  // namespace

Scene makeFloor(const FloorShape& shape) {
  const FloorShape plain;
  const bool isCut = shape.triangles != plain.triangles || shape.needle != plain.needle ||
                     shape.copies != plain.copies;
  if (shape.ior && (isCut || shape.slopeDegrees != 0.0 || shape.sun != 1.0 || shape.spots != 0))
    failInput("scene 'floor': 'ior' makes it a slab of glass, and goes with 'view' alone");
  if (shape.needle != plain.needle && shape.triangles != plain.triangles)
    failInput("scene 'floor': 'needle' and 'triangles' both say how many there are; give one");
  if (shape.spots != 0 && shape.sun != 1.0)
    failInput("scene 'floor': 'spots' stand instead of the sky, and 'sun' is in it; give one");
  SceneBuilder builder("floor");
  if (shape.ior)
    addSlab(builder, *shape.ior);
  else
    addFloors(builder, shape);
  if (shape.spots > 0) {
    addSpots(builder, shape.spots);
  } else {
    builder.setEnvironment(skyWithSun(shape.sun));
  }
  const double angle = glm::radians(shape.viewDegrees);
  const glm::dvec3 eye = 3.0 * glm::dvec3(0.0, std::cos(angle), std::sin(angle));
  // An upright camera cannot look straight down: aim slightly beside the centre instead.
  builder.addCamera("eye", eye, {0.0, 0.0, shape.viewDegrees < 1.0 ? -0.05 : 0.0}, 36.0);
  Scene scene = builder.finish();
  if (shape.slopeDegrees > 0.0) lean(scene, shape.slopeDegrees);
  return scene;
}

}  // namespace restlab::builtin
