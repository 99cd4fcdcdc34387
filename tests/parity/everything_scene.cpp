#include "tests/parity/everything_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace restlab::parity {

namespace {

enum Mesh { kFloor, kCeiling, kBackWall, kRightWall, kLeftWall, kShortBlock, kTallBlock, kLamp };

uint32_t texel(uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
  return r | g << 8 | b << 16 | a << 24;
}

// Adds an image of 4 x 4 texels that differ in every channel.
uint32_t addImage(Scene& scene, uint32_t base, uint32_t alphaStep) {
  TextureImage image{"pattern", 4, 4, {}};
  for (uint32_t i = 0; i < 16; ++i) {
    image.texels.push_back(
        texel(base + 7 * i, 255 - 9 * i, 120 + 5 * (i % 4), 255 - alphaStep * i));
  }
  scene.images.push_back(image);
  return static_cast<uint32_t>(scene.images.size() - 1);
}

// Adds a sampler's use of the image; every wrap mode and filter occurs once among three uses.
uint32_t addUse(Scene& scene, uint32_t image, uint32_t wrap, bool srgb, bool nearest) {
  TextureUse use;
  use.image = image;
  use.wrapU = use.wrapV = wrap;
  use.srgb = srgb;
  use.nearest = nearest;
  use.uvRow0 = {1.3f, 0.4f, 0.1f};
  use.uvRow1 = {-0.4f, 1.3f, 0.7f};
  scene.textureUses.push_back(use);
  return static_cast<uint32_t>(scene.textureUses.size() - 1);
}

// Gives a mesh its own copy of its material, to be changed by the caller.
rl::Material& ownMaterial(Scene& scene, Mesh mesh) {
  scene.materials.push_back(scene.materials[scene.instances[mesh].material]);
  scene.instances[mesh].material = static_cast<uint32_t>(scene.materials.size() - 1);
  return scene.materials.back().data;
}

void addUvs(MeshGeometry& geometry) {
  for (const glm::vec3& p : geometry.positions)
    geometry.uvs[0].emplace_back(0.31f * p.x + 0.11f * p.z, 0.23f * p.y - 0.2f * p.z);
}

void addTextures(Scene& scene) {
  for (Mesh mesh : {kFloor, kBackWall, kLeftWall, kRightWall, kLamp})
    addUvs(scene.geometries[mesh]);
  const uint32_t pattern = addImage(scene, 100, 0), holes = addImage(scene, 90, 12);
  rl::Material& floor = ownMaterial(scene, kFloor);
  floor.textures[rl::RL_TEX_BASE_COLOR] = addUse(scene, pattern, rl::RL_WRAP_REPEAT, true, false);
  floor.textures[rl::RL_TEX_METALLIC_ROUGHNESS] =
      addUse(scene, pattern, rl::RL_WRAP_MIRROR, false, true);
  floor.metallic = 0.8f;
  floor.roughness = 0.9f;
  rl::Material& back = ownMaterial(scene, kBackWall);
  back.textures[rl::RL_TEX_NORMAL] = addUse(scene, pattern, rl::RL_WRAP_CLAMP, false, false);
  back.normalScale = 0.4f;  // bent so far that reflections go through the wall
  back.metallic = 0.7f;
  back.roughness = 0.5f;
  rl::Material& left = ownMaterial(scene, kLeftWall);
  left.textures[rl::RL_TEX_BASE_COLOR] = addUse(scene, holes, rl::RL_WRAP_REPEAT, true, false);
  left.flags |= rl::RL_MATERIAL_ALPHA_BLEND | rl::RL_MATERIAL_DOUBLE_SIDED;
  rl::Material& lamp = ownMaterial(scene, kLamp);
  lamp.textures[rl::RL_TEX_EMISSIVE] = addUse(scene, pattern, rl::RL_WRAP_REPEAT, true, false);
  for (size_t i = 0; i < scene.geometries[kRightWall].positions.size(); ++i) {
    scene.geometries[kRightWall].colors.emplace_back(0.3f + 0.1f * float(i), 0.9f - 0.1f * float(i),
                                                     0.5f, 1.0f);
  }
}

void addGlass(Scene& scene) {
  MeshGeometry& block = scene.geometries[kTallBlock];
  glm::vec3 centre(0.0f);
  for (const glm::vec3& p : block.positions) centre += p / float(block.positions.size());
  for (const glm::vec3& p : block.positions) block.normals.push_back(glm::normalize(p - centre));
  rl::Material& glass = ownMaterial(scene, kTallBlock);
  glass.baseColor = {0.95f, 0.97f, 0.99f};
  glass.roughness = 0.3f;
  glass.ior = 1.5f;
  glass.specular = 1.0f;
  glass.specularColor = {1.0f, 1.0f, 1.0f};
  glass.transmission = 0.9f;
  glass.sigmaAbsorption = {0.3f, 0.1f, 0.2f};
  SceneMaterial& body = scene.materials[scene.instances[kTallBlock].material];
  body.sigmaScattering = {1.0f, 0.5f, 2.0f};
  body.phase = 0.3f;
}

void addInstance(Scene& scene) {
  MeshInstance mirrored = scene.instances[kShortBlock];
  mirrored.objectToWorld = glm::translate(glm::dmat4(1.0), {-3.5, 2.0, -1.0}) *
                           glm::scale(glm::dmat4(1.0), {-0.4, 0.5, 0.4}) * mirrored.objectToWorld;
  scene.instances.push_back(mirrored);
}

// A small copy of the glass, whose light leaves it by a diffusion profile.
void addCandle(Scene& scene) {
  MeshInstance candle = scene.instances[kTallBlock];
  SceneMaterial wax = scene.materials[candle.material];
  wax.hasDiffusion = true;
  wax.sigmaScattering = {20.0f, 30.0f, 40.0f};
  candle.material = uint32_t(scene.materials.size());
  scene.materials.push_back(wax);
  candle.objectToWorld = glm::translate(glm::dmat4(1.0), {0.0, 2.0, 0.5}) *
                         glm::scale(glm::dmat4(1.0), {0.4, 0.3, 0.4}) * candle.objectToWorld;
  scene.instances.push_back(candle);
}

void addLights(Scene& scene) {
  PunctualLight point{
      "point", rl::RL_LIGHT_POINT, {-1.0, 3.0, -1.0}, {0, -1, 0}, glm::vec3(3.0f, 2.0f, 1.0f)};
  point.attenuation = {0.1f, 0.2f, 0.7f};
  PunctualLight spot{
      "spot", rl::RL_LIGHT_SPOT, {-4.0, 5.0, -2.0}, {0.2, -0.95, 0.1}, glm::vec3(9.0f)};
  spot.innerConeAngle = 0.3f;
  spot.outerConeAngle = 0.6f;
  spot.dirW = glm::normalize(spot.dirW);
  PunctualLight sun{"sun",
                    rl::RL_LIGHT_DIRECTIONAL,
                    {},
                    glm::normalize(glm::dvec3(0.1, -0.4, -0.9)),
                    glm::vec3(0.5f)};
  scene.lights = {point, spot, sun};
  EnvironmentMap sky{"sky", 8, 4, {}, 0.7f, 1.0f};
  for (uint32_t i = 0; i < 32; ++i)
    sky.radiance.push_back(glm::vec3(0.2f, 0.3f, 0.5f) * (1.0f + 0.2f * float(i % 5)));
  scene.environment = sky;
  scene.ambient = {0.02f, 0.03f, 0.01f};
  scene.background = glm::vec3(0.4f, 0.3f, 0.2f);
}

}  // namespace

Scene makeEverythingScene() {
  Scene scene = makeBuiltinScene("cornell-box");
  addTextures(scene);
  addGlass(scene);
  addInstance(scene);
  addCandle(scene);
  addLights(scene);
  return scene;
}

}  // namespace restlab::parity
