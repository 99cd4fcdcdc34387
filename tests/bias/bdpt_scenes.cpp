#include "tests/bias/bdpt_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/scene.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/analytic/inconsistent_normals.h"
#include "tests/unit/layered.h"

namespace restlab::bias {
namespace {

using namespace builtin;

const glm::vec3 kGrey(0.7f, 0.6f, 0.5f), kNoLoss(0.0f);

// A floor and a back wall, open to a sky.
void addStage(SceneBuilder& scene) {
  const uint32_t wall = scene.addMaterial("wall", lambert(kGrey));
  scene.add(quad("floor", {-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -5.0}), wall);
  scene.add(quad("back", {-2.0, 0.0, -3.0}, {4.0, 0.0, 0.0}, {0.0, 3.0, 0.0}), wall);
}

void addEye(SceneBuilder& scene) {
  scene.addCamera("front", {0.3, 1.6, 1.9}, {0.0, 0.8, -1.5}, 60.0);
}

EnvironmentMap brightSky() {
  EnvironmentMap sky;
  sky.source = "sky";
  sky.width = 16;
  sky.height = 8;
  sky.radiance.assign(size_t(128), glm::vec3(0.3f, 0.4f, 0.6f));
  sky.radiance[37] = glm::vec3(12.0f, 10.0f, 8.0f);
  sky.rotation = 0.4f;
  return sky;
}

Scene punctualLights() {
  SceneBuilder scene("punctual lights");
  addStage(scene);
  scene.add(box("block", {-0.9, 0.0, -2.0}, {-0.1, 1.1, -1.2}),
            scene.addMaterial("block", plastic({0.2f, 0.4f, 0.7f}, 0.4f)));
  scene.add(sphere("ball", {0.8, 0.5, -1.2}, 0.5, 3),
            scene.addMaterial("ball", metal({0.9f, 0.7f, 0.4f}, 0.4f)));
  PunctualLight point;
  point.name = "point";
  point.posW = {-1.2, 2.0, -0.6};
  point.intensity = glm::vec3(3.0f, 2.0f, 1.0f);
  point.attenuation = {0.5f, 0.2f, 0.6f};
  scene.addLight(point);
  PunctualLight spot;
  spot.name = "spot";
  spot.kind = rl::RL_LIGHT_SPOT;
  spot.posW = {1.4, 2.4, 0.2};
  spot.dirW = glm::normalize(glm::dvec3(-0.4, -1.0, -0.9));
  spot.intensity = glm::vec3(8.0f);
  spot.innerConeAngle = 0.3f;
  spot.outerConeAngle = 0.5f;
  scene.addLight(spot);
  PunctualLight sun;
  sun.name = "sun";
  sun.kind = rl::RL_LIGHT_DIRECTIONAL;
  sun.dirW = glm::normalize(glm::dvec3(0.5, -1.0, -0.6));
  sun.intensity = glm::vec3(0.6f, 0.5f, 0.4f);
  scene.addLight(sun);
  addEye(scene);
  return scene.finish();
}

Scene sky() {
  SceneBuilder scene("sky");
  addStage(scene);
  scene.add(box("block", {-0.9, 0.0, -2.0}, {-0.1, 1.1, -1.2}),
            scene.addMaterial("block", metal({0.9f, 0.7f, 0.4f}, 0.5f)));
  scene.add(sphere("ball", {0.8, 0.5, -1.2}, 0.5, 3),
            scene.addMaterial("ball", glass(0.0f, kNoLoss)));
  scene.setEnvironment(brightSky());
  addEye(scene);
  return scene.finish();
}

// A lamp inside of smooth glass: only light's paths and those that meet the lamp leave it.
Scene lampInGlass() {
  SceneBuilder scene("lamp in glass");
  addStage(scene);
  scene.add(sphere("glass", {0.0, 1.0, -1.4}, 0.6, 3),
            scene.addMaterial("glass", glass(0.0f, {0.3f, 0.6f, 1.2f})));
  scene.add(sphere("lamp", {0.0, 1.0, -1.4}, 0.3, 1, false),
            scene.addMaterial("lamp", lamp({6.0f, 6.0f, 6.0f})));
  addEye(scene);
  return scene.finish();
}

Scene screens() {
  rl::Material half = lambert({0.6f, 0.3f, 0.2f});
  half.alpha = 0.5f;
  half.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  Scene scene = bdptRoom("screens", half, half);
  for (SceneMaterial& m : scene.materials) {
    if (m.name != "lamp") continue;
    m.data.alpha = 0.6f;
    m.data.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  }
  return scene;
}

// Lamps of every shape that has light samples of its own.
Scene shapeLamps() {
  SceneBuilder scene("lamps of shapes");
  addStage(scene);
  double x = -1.5;
  for (const char* kind : {"sphere", "disk", "rectangle", "cylinder", "cube"}) {
    ShapeGeometry shape{findShape(kind), {}};
    for (const ShapeParameter& p : shape.info->parameters)
      shape.values.push_back(float(p.fallback));
    rl::Material light = lamp({2.0f, 1.5f, 1.0f});
    light.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(x, 1.2, -1.6));
    place = glm::rotate(place, 0.7, glm::dvec3(1.0, 0.3, 0.2));
    place = glm::scale(place, glm::dvec3(0.2, 0.3, 0.25));
    scene.place(kind, scene.addGeometry(makeShape(shape, kind)), scene.addMaterial(kind, light),
                place);
    x += 0.75;
  }
  addEye(scene);
  return scene.finish();
}

// Overlapping bodies that absorb, a lamp in one of them, and the camera in the other.
Scene nestedBodies() {
  SceneBuilder scene("nested bodies");
  addStage(scene);
  scene.add(box("water", {-1.9, 0.001, -2.9}, {1.9, 0.9, 1.0}),
            scene.addMaterial("water", glass(0.3f, {0.6f, 0.3f, 0.1f})));
  scene.add(box("block", {-1.2, -0.1, -2.0}, {0.1, 1.4, -0.8}),
            scene.addMaterial("block", glass(0.5f, {0.1f, 0.6f, 0.8f})));
  scene.add(quad("sunk lamp", {0.5, 0.5, -2.0}, {0.6, 0.0, 0.0}, {0.0, 0.2, 0.6}),
            scene.addMaterial("sunk lamp", lamp({4.0f, 4.0f, 4.0f})));
  scene.add(quad("lamp", {-1.0, 2.6, -2.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0}),
            scene.addMaterial("lamp", lamp({3.0f, 3.0f, 3.0f})));
  addEye(scene);
  return scene.finish();
}

Scene layers() {
  rl::Material leaf = plastic({0.3f, 0.6f, 0.2f}, 0.5f);
  leaf.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
  Scene scene = bdptRoom("layers", glass(0.5f, kNoLoss), metal({0.9f, 0.7f, 0.4f}, 0.5f));
  for (SceneMaterial& m : scene.materials) {
    if (m.name == "block")
      m = unit::layered(m.data, {.coat = 0.5f, .coatRoughness = 0.6f, .dispersion = 4.0f});
    if (m.name == "ball")
      m = unit::layered(
          m.data, {.coat = 1.0f, .coatRoughness = 0.0f, .anisotropy = 0.8f, .rotation = 0.5f});
    if (m.name == "wall")
      m = unit::layered(
          m.data,
          {.sheen = {0.2f, 0.2f, 0.2f}, .passing = 0.3f, .passingColor = {0.4f, 0.9f, 0.2f}});
  }
  return scene;
}

Scene mappedNormals() {
  Scene scene = bdptRoom("mapped normals", plastic({0.3f, 0.5f, 0.6f}, 0.4f), lambert(kGrey));
  const uint32_t bumps = analytic::addBumps(scene, 0.5f);
  for (MeshInstance& instance : scene.instances) {
    MeshGeometry& mesh = scene.geometries[instance.geometry];
    if (!mesh.uvs[0].empty()) continue;
    for (const glm::vec3& p : mesh.positions) mesh.uvs[0].emplace_back(p.x + p.y, p.z - p.y);
  }
  for (SceneMaterial& m : scene.materials)
    if (m.name != "lamp") m.data.textures[rl::RL_TEX_NORMAL] = bumps;
  return scene;
}

// A body whose inside scatters, before a lamp.
Scene wax(bool hasDiffusion) {
  Scene scene = bdptRoom("wax", glass(0.4f, kNoLoss), lambert(kGrey));
  for (SceneMaterial& m : scene.materials) {
    if (m.name != "block") continue;
    const glm::vec3 extinction(4.0f, 6.0f, 8.0f);
    m.sigmaScattering = extinction * 0.8f;
    m.data.sigmaAbsorption = extinction - m.sigmaScattering;
    m.phase = 0.2f;
    m.hasDiffusion = hasDiffusion;
  }
  return scene;
}

// Everything in a thin fog, lamp and camera too.
Scene fog() {
  Scene scene = bdptRoom("fog", lambert(kGrey), metal({0.9f, 0.7f, 0.4f}, 0.3f));
  rl::Material air = glass(0.0f, kNoLoss);
  air.ior = 1.0f;
  SceneMaterial material;
  material.name = "fog";
  material.data = air;
  material.sigmaScattering = glm::vec3(0.25f, 0.3f, 0.35f);
  material.data.sigmaAbsorption = glm::vec3(0.05f);
  material.phase = 0.3f;
  scene.materials.push_back(material);
  scene.geometries.push_back(box("fog", {-1.95, 0.02, -2.95}, {1.95, 2.95, 1.97}));
  MeshInstance instance;
  instance.name = "fog";
  instance.geometry = uint32_t(scene.geometries.size() - 1);
  instance.material = uint32_t(scene.materials.size() - 1);
  scene.instances.push_back(instance);
  return scene;
}

// A sun low above a plane that reaches far beyond what a box of the scene may hold.
Scene farGround() {
  SceneBuilder scene("far ground");
  ShapeGeometry plane{findShape("plane"), {}};
  for (const ShapeParameter& p : plane.info->parameters)
    plane.values.push_back(p.name == std::string("size") ? 40.0f : float(p.fallback));
  const glm::dmat4 flat =
      glm::rotate(glm::dmat4(1.0), -glm::radians(90.0), glm::dvec3(1.0, 0.0, 0.0));
  scene.place("ground", scene.addGeometry(makeShape(plane, "ground")),
              scene.addMaterial("ground", lambert(kGrey)), flat);
  scene.add(box("block", {-0.5, 0.0, -1.0}, {0.5, 1.0, 0.0}),
            scene.addMaterial("block", lambert({0.2f, 0.4f, 0.7f})));
  PunctualLight sun;
  sun.name = "sun";
  sun.kind = rl::RL_LIGHT_DIRECTIONAL;
  sun.dirW = glm::normalize(glm::dvec3(0.0, -0.5, 1.0));
  sun.intensity = glm::vec3(2.0f);
  scene.addLight(sun);
  scene.setEnvironment(brightSky());
  scene.addCamera("front", {0.0, 1.6, 4.0}, {0.0, 0.3, -6.0}, 60.0);
  return scene.finish();
}

// More lights than blocks of the table, a point among them, and a sky in its block.
Scene crowdedSky() {
  SceneBuilder scene("crowded sky");
  addStage(scene);
  scene.add(sphere("lamps", {0.8, 0.6, -1.2}, 0.4, 3, false),
            scene.addMaterial("lamps", lamp({0.5f, 0.4f, 0.3f})));
  PunctualLight point;
  point.name = "point";
  point.posW = {-1.0, 1.8, -0.6};
  point.intensity = glm::vec3(6.0f);
  scene.addLight(point);
  scene.setEnvironment(brightSky());
  addEye(scene);
  return scene.finish();
}

Scene ambientLight() {
  Scene scene = bdptRoom("ambient", lambert(kGrey), metal({0.9f, 0.7f, 0.4f}, 0.3f));
  scene.ambient = glm::vec3(0.1f, 0.2f, 0.3f);
  scene.background = glm::vec3(0.5f, 0.1f, 0.1f);
  return scene;
}

Scene parallelEye() {
  Scene scene = bdptRoom("orthographic", metal({0.9f, 0.7f, 0.4f}, 0.2f), glass(0.3f, kNoLoss));
  SceneCamera& camera = scene.cameras.at(0);
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = 1.2;
  return scene;
}

// `path` finds no light of a point that smooth surfaces send on.
Scene pointAmongSmooth() {
  Scene scene = bdptRoom("point among smooth surfaces", metal({0.9f, 0.9f, 0.9f}, 0.0f),
                         glass(0.0f, kNoLoss), false);
  PunctualLight point;
  point.name = "point";
  point.posW = {0.3, 2.4, -1.4};
  point.intensity = glm::vec3(4.0f);
  scene.lights.push_back(point);
  return scene;
}

}  // namespace

Scene bdptRoom(const std::string& name, const rl::Material& block, const rl::Material& ball,
               bool hasLamp) {
  SceneBuilder scene(name);
  scene.add(insideOut(box("room", {-2.0, 0.0, -3.0}, {2.0, 3.0, 2.0})),
            scene.addMaterial("wall", lambert(kGrey)));
  if (hasLamp) {
    rl::Material light = lamp({4.0f, 3.5f, 3.0f});
    light.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    scene.add(quad("lamp", {-0.5, 2.2, -1.9}, {1.0, 0.0, 0.0}, {0.0, 0.3, 1.0}),
              scene.addMaterial("lamp", light));
  }
  scene.add(box("block", {-1.2, 0.01, -2.0}, {-0.2, 1.1, -1.0}), scene.addMaterial("block", block));
  scene.add(sphere("ball", {0.8, 0.55, -1.2}, 0.5, 3), scene.addMaterial("ball", ball));
  addEye(scene);
  return scene.finish();
}

const std::vector<BdptScene>& bdptScenes() {
  static const std::vector<BdptScene> all = {
      {"glossy",
       [] {
         return bdptRoom("glossy", metal({0.9f, 0.7f, 0.4f}, 0.25f),
                         plastic({0.2f, 0.4f, 0.7f}, 0.3f));
       }},
      {"smooth",
       [] {
         return bdptRoom("smooth", metal({0.9f, 0.9f, 0.9f}, 0.0f), glass(0.0f, kNoLoss));
       }},
      {"frosted", [] { return bdptRoom("frosted", glass(0.5f, kNoLoss), glass(0.25f, kNoLoss)); }},
      {"punctual", punctualLights},
      {"point-among-smooth", pointAmongSmooth},
      {"sky", sky},
      {"lamp-in-glass", lampInGlass},
      {"screens", screens},
      {"shape-lamps", shapeLamps},
      {"nested", nestedBodies},
      {"layers", layers},
      {"mapped-normals", mappedNormals},
      {"wax", [] { return wax(false); }},
      {"profile", [] { return wax(true); }},
      {"fog", fog},
      {"far-ground", farGround},
      {"crowded-sky", crowdedSky},
      {"ambient", ambientLight},
      {"orthographic", parallelEye},
  };
  return all;
}

}  // namespace restlab::bias
