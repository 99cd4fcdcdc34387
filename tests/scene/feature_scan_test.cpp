// The feature scan: each bit is set exactly by the content that needs it.
#include <gtest/gtest.h>

#include <map>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

using builtin::glass;
using builtin::lambert;
using builtin::metal;
using builtin::plastic;

// A flat square with a material.
Scene square(const rl::Material& material) {
  Scene scene;
  scene.geometries.push_back(builtin::quad("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  scene.materials.push_back({"material", material});
  scene.instances.push_back({"square", 0, 0, glm::dmat4(1.0)});
  return scene;
}

rl::FeatureMask scanOf(const rl::Material& material) { return scanFeatures(square(material)); }

// Puts a 2 x 1 image of two texels into a slot.
void setTexture(Scene& scene, uint32_t slot, uint32_t texelA, uint32_t texelB) {
  scene.images.push_back({"image", 2, 1, {texelA, texelB}});
  TextureUse use;
  use.image = uint32_t(scene.images.size() - 1);
  scene.textureUses.push_back(use);
  scene.materials[0].data.textures[slot] = uint32_t(scene.textureUses.size() - 1);
}

rl::FeatureMask scanTextured(const rl::Material& material, uint32_t slot, uint32_t texelA,
                             uint32_t texelB) {
  Scene scene = square(material);
  setTexture(scene, slot, texelA, texelB);
  return scanFeatures(scene);
}

constexpr uint32_t kWhite = 0xffffffffu, kBlack = 0xff000000u, kNone = 0u;
const rl::Material kGray = lambert(glm::vec3(0.5f));

rl::Material with(rl::Material m, uint32_t flags) {
  m.flags |= flags;
  return m;
}

TEST(FeatureScan, NothingNeedsNothing) {
  EXPECT_EQ(scanFeatures(Scene()), 0u);
  EXPECT_EQ(scanOf(kGray), 0u);
}

TEST(FeatureScan, BuiltinScenes) {
  const std::map<std::string, rl::FeatureMask> expected{
      {"cornell-box", rl::RL_FEATURE_AREA_LIGHTS},
      {"door-ajar", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_SMOOTH_NORMALS},
      {"many-lights", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_SMOOTH_NORMALS},
      {"glossy-gallery",
       rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_SMOOTH_NORMALS},
      {"glass", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TRANSMISSION |
                    rl::RL_FEATURE_VOLUME | rl::RL_FEATURE_SMOOTH_NORMALS},
      {"course", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TRANSMISSION |
                     rl::RL_FEATURE_SMOOTH_NORMALS},
      {"courtyard", rl::RL_FEATURE_PUNCTUAL_LIGHTS | rl::RL_FEATURE_ENVIRONMENT |
                        rl::RL_FEATURE_INSTANCES | rl::RL_FEATURE_SMOOTH_NORMALS},
      {"furnace", rl::RL_FEATURE_AREA_LIGHTS},
      {"sphere-furnace", rl::RL_FEATURE_ENVIRONMENT},
      {"floor", rl::RL_FEATURE_ENVIRONMENT},
      {"quad-light", rl::RL_FEATURE_AREA_LIGHTS},
      {"media", rl::RL_FEATURE_ENVIRONMENT | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TRANSMISSION |
                    rl::RL_FEATURE_VOLUME},
      {"implicit",
       rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_SHAPE_IMPLICIT},
      {"sdf", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_SHAPE_SDF},
      {"hair", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_SMOOTH_NORMALS |
                   rl::RL_FEATURE_SHAPE_CURVES},
      {"teapot",
       rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_SMOOTH_NORMALS},
      {"ball", rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_SHAPE_SPHERE |
                   rl::RL_FEATURE_SHAPE_RECTANGLE},
  };
  for (const std::string& name : builtinSceneNames()) {
    if (name == "shapes" || name == "shape-furnace") continue;  // of every kind
    ASSERT_EQ(expected.count(name), 1u) << name;
    EXPECT_EQ(scanFeatures(makeBuiltinScene(name)), expected.at(name)) << name;
  }
}

TEST(FeatureScan, UnusedPartsDoNotCount) {
  Scene scene = square(kGray);
  scene.materials.push_back({"unused", glass(0.1f, glm::vec3(1.0f))});
  MeshGeometry smooth = builtin::sphere("unused", {0, 0, 0}, 1.0, 1);
  smooth.colors.assign(smooth.positions.size(), glm::vec4(0.5f));
  scene.geometries.push_back(smooth);
  EXPECT_EQ(scanFeatures(scene), 0u);
  MeshGeometry empty;
  scene.geometries.push_back(empty);
  scene.instances.push_back({"no triangles", 2, 1, glm::dmat4(1.0)});
  EXPECT_EQ(scanFeatures(scene), 0u);
}

TEST(FeatureScan, AreaLights) {
  rl::Material glowing = kGray;
  glowing.emission = {0.0f, 0.0f, 1e-6f};
  EXPECT_EQ(scanOf(glowing), rl::RL_FEATURE_AREA_LIGHTS);
  EXPECT_EQ(scanOf(with(glowing, rl::RL_MATERIAL_UNLIT)), 0u) << "unlit is seen, but no light";
  Scene flat = square(glowing);
  flat.instances[0].objectToWorld[0] = glm::dvec4(0.0);
  EXPECT_EQ(scanFeatures(flat), 0u) << "no area after the transform";
  Scene line = square(glowing);
  for (glm::vec3& p : line.geometries[0].positions) p.y = p.x;
  EXPECT_EQ(scanFeatures(line), 0u) << "no area in the mesh";
}

TEST(FeatureScan, EmissiveTextures) {
  rl::Material glowing = kGray;
  glowing.emission = glm::vec3(2.0f, 0.0f, 0.0f);
  const uint32_t slot = rl::RL_TEX_EMISSIVE;
  EXPECT_EQ(scanTextured(glowing, slot, kBlack, 0xff0000ffu),
            rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_EMISSIVE_TEXTURES);
  EXPECT_EQ(scanTextured(glowing, slot, kBlack, 0xffffff00u), 0u) << "no red anywhere";
  EXPECT_EQ(scanTextured(kGray, slot, kWhite, kWhite), 0u) << "factor 0";
}

TEST(FeatureScan, PunctualLightsAndEnvironment) {
  Scene scene = square(kGray);
  scene.lights.push_back({});
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_PUNCTUAL_LIGHTS);
  scene.lights[0].intensity = glm::vec3(0.0f);
  EXPECT_EQ(scanFeatures(scene), 0u);
  EnvironmentMap map;
  map.width = 2;
  map.height = 1;
  map.radiance = {glm::vec3(0.0f), glm::vec3(0.0f, 0.1f, 0.0f)};
  scene.environment = map;
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_ENVIRONMENT);
  scene.environment->scale = 0.0f;
  EXPECT_EQ(scanFeatures(scene), 0u);
  scene.environment->scale = 1.0f;
  scene.environment->radiance[1] = glm::vec3(0.0f);
  EXPECT_EQ(scanFeatures(scene), 0u) << "black";
}

TEST(FeatureScan, Glossy) {
  const rl::FeatureMask glossy = rl::RL_FEATURE_GLOSSY;
  EXPECT_EQ(scanOf(plastic(glm::vec3(0.5f), 0.4f)), glossy);
  EXPECT_EQ(scanOf(metal(glm::vec3(0.5f), 0.4f)), glossy);
  rl::Material m = plastic(glm::vec3(0.5f), 0.4f);
  m.ior = 1.0f;
  EXPECT_EQ(scanOf(m), 0u) << "no contrast of indices";
  m = plastic(glm::vec3(0.5f), 0.4f);
  m.specularColor = glm::vec3(0.0f);
  EXPECT_EQ(scanOf(m), 0u) << "black specular colour";
  m = metal(glm::vec3(0.0f), 0.4f);
  EXPECT_EQ(scanOf(m), 0u) << "black metal";
  m = kGray;
  m.metallic = 0.01f;
  EXPECT_EQ(scanOf(m), glossy) << "a trace of metal";
  EXPECT_EQ(scanOf(with(plastic(glm::vec3(0.5f), 0.4f), rl::RL_MATERIAL_BLACK)), 0u);
  EXPECT_EQ(scanOf(with(plastic(glm::vec3(0.5f), 0.4f), rl::RL_MATERIAL_UNLIT)), 0u);
}

TEST(FeatureScan, TexturesDecideAboutLobes) {
  const uint32_t slot = rl::RL_TEX_METALLIC_ROUGHNESS;
  rl::Material m = kGray;
  m.metallic = 1.0f;
  EXPECT_EQ(scanTextured(m, slot, 0xff00ff00u, 0xff01ff00u),
            rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TEXTURES)
      << "blue 1/255 somewhere";
  EXPECT_EQ(scanTextured(m, slot, 0xff00ff00u, 0xff00ff00u), 0u) << "no metal in any texel";
  EXPECT_EQ(scanTextured(kGray, slot, kWhite, kWhite), 0u) << "factor 0, Lambert throughout";
  m = plastic(glm::vec3(0.5f), 0.4f);
  EXPECT_EQ(scanTextured(m, rl::RL_TEX_SPECULAR, 0x00ffffffu, 0x00ffffffu), 0u) << "alpha 0";
  EXPECT_EQ(scanTextured(m, rl::RL_TEX_SPECULAR_COLOR, kBlack, kBlack), 0u);
  EXPECT_EQ(scanTextured(m, rl::RL_TEX_SPECULAR_COLOR, kBlack, kWhite),
            rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TEXTURES);
}

TEST(FeatureScan, BaseColorTexture) {
  EXPECT_EQ(scanTextured(kGray, rl::RL_TEX_BASE_COLOR, kWhite, kBlack), rl::RL_FEATURE_TEXTURES);
  EXPECT_EQ(scanTextured(with(kGray, rl::RL_MATERIAL_UNLIT), rl::RL_TEX_BASE_COLOR, kWhite, kBlack),
            rl::RL_FEATURE_TEXTURES)
      << "unlit shows its base colour";
}

TEST(FeatureScan, TransmissionAndVolume) {
  const rl::FeatureMask transmission = rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TRANSMISSION;
  EXPECT_EQ(scanOf(glass(0.0f, glm::vec3(0.0f))), transmission);
  EXPECT_EQ(scanOf(glass(0.0f, {0.0f, 0.1f, 0.0f})), transmission | rl::RL_FEATURE_VOLUME);
  EXPECT_EQ(scanOf(with(glass(0.0f, glm::vec3(0.1f)), rl::RL_MATERIAL_THIN)), transmission)
      << "a thin sheet has no inside";
  rl::Material m = glass(0.0f, glm::vec3(0.1f));
  m.metallic = 1.0f;
  EXPECT_EQ(scanOf(m), rl::RL_FEATURE_GLOSSY) << "metal is opaque";
  m = plastic(glm::vec3(0.5f), 0.4f);
  m.sigmaAbsorption = glm::vec3(0.1f);
  EXPECT_EQ(scanOf(m), rl::RL_FEATURE_GLOSSY) << "nothing gets inside";
  EXPECT_EQ(scanTextured(glass(0.0f, glm::vec3(0.1f)), rl::RL_TEX_TRANSMISSION, kBlack, kBlack),
            rl::RL_FEATURE_GLOSSY | rl::RL_FEATURE_TEXTURES)
      << "opaque in every texel";
  m = kGray;
  m.transmission = 0.5f;
  EXPECT_EQ(scanOf(m), transmission) << "without any reflection";
}

TEST(FeatureScan, NormalMaps) {
  const uint32_t slot = rl::RL_TEX_NORMAL;
  EXPECT_EQ(scanTextured(kGray, slot, 0xffff8080u, 0xffff8080u), rl::RL_FEATURE_NORMAL_MAPS);
  rl::Material m = kGray;
  m.normalScale = 0.0f;
  EXPECT_EQ(scanTextured(m, slot, 0xffff8080u, 0xffff8080u), 0u);
  EXPECT_EQ(scanTextured(with(kGray, rl::RL_MATERIAL_BLACK), slot, 0xffff8080u, 0xffff8080u), 0u);
}

TEST(FeatureScan, VertexColors) {
  Scene scene = square(kGray);
  scene.geometries[0].colors.assign(4, glm::vec4(1.0f));
  EXPECT_EQ(scanFeatures(scene), 0u) << "all one";
  scene.geometries[0].colors[3].w = 0.5f;
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_VERTEX_COLORS);
}

TEST(FeatureScan, Alpha) {
  const uint32_t mask = rl::RL_MATERIAL_ALPHA_MASK, blend = rl::RL_MATERIAL_ALPHA_BLEND;
  rl::Material m = kGray;
  m.alpha = 0.6f;
  EXPECT_EQ(scanOf(m), 0u) << "opaque ignores alpha";
  EXPECT_EQ(scanOf(with(m, blend)), rl::RL_FEATURE_ALPHA);
  EXPECT_EQ(scanOf(with(m, mask)), 0u) << "above the cutoff";
  m.alpha = 0.4f;
  EXPECT_EQ(scanOf(with(m, mask)), rl::RL_FEATURE_ALPHA);
  EXPECT_EQ(scanOf(with(kGray, blend)), 0u) << "alpha 1";
  EXPECT_EQ(scanOf(with(m, mask | rl::RL_MATERIAL_UNLIT)), rl::RL_FEATURE_ALPHA);
  // Alpha channel of the base colour texture: one texel a hole, or just above the cutoff of 1/2.
  const uint32_t slot = rl::RL_TEX_BASE_COLOR;
  EXPECT_EQ(scanTextured(with(kGray, mask), slot, kWhite, 0x7fffffffu),
            rl::RL_FEATURE_ALPHA | rl::RL_FEATURE_TEXTURES);
  EXPECT_EQ(scanTextured(with(kGray, mask), slot, kWhite, 0x80ffffffu), rl::RL_FEATURE_TEXTURES);
  EXPECT_EQ(scanTextured(with(kGray, blend), slot, kWhite, 0xfeffffffu),
            rl::RL_FEATURE_ALPHA | rl::RL_FEATURE_TEXTURES);
  EXPECT_EQ(scanTextured(kGray, slot, kNone, kNone), rl::RL_FEATURE_TEXTURES);
  // Alpha of vertex colours.
  Scene scene = square(with(kGray, blend));
  scene.geometries[0].colors.assign(4, glm::vec4(1.0f, 1.0f, 1.0f, 0.9f));
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_ALPHA | rl::RL_FEATURE_VERTEX_COLORS);
}

TEST(FeatureScan, Instances) {
  Scene scene = square(kGray);
  scene.instances[0].objectToWorld[3].x = 5.0;
  EXPECT_EQ(scanFeatures(scene), 0u) << "used once: baked";
  scene.instances.push_back(scene.instances[0]);
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_INSTANCES);
}

TEST(FeatureScan, SmoothNormals) {
  Scene scene = square(kGray);
  MeshGeometry& mesh = scene.geometries[0];
  mesh.normals.assign(4, glm::vec3(0.0f, 0.0f, 1.0f));
  EXPECT_EQ(scanFeatures(scene), 0u) << "they are the face's";
  mesh.normals[2] = glm::normalize(glm::vec3(5e-5f, 0.0f, 1.0f));
  EXPECT_EQ(scanFeatures(scene), 0u) << "within tolerance";
  mesh.normals[2] = glm::normalize(glm::vec3(2e-4f, 0.0f, 1.0f));
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_SMOOTH_NORMALS);
  mesh.normals.assign(4, glm::vec3(0.0f, 0.0f, -1.0f));
  EXPECT_EQ(scanFeatures(scene), rl::RL_FEATURE_SMOOTH_NORMALS) << "turned over";
  // Lengths other than one do not matter, and a triangle without area has no normal to differ from.
  mesh.normals.assign(4, glm::vec3(0.0f, 0.0f, 3.0f));
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_EQ(scanFeatures(scene), 0u);
}

TEST(FeatureScan, MultiscatterIsNeverAScenesNeed) {
  for (const std::string& name : builtinSceneNames()) {
    EXPECT_EQ(scanFeatures(makeBuiltinScene(name)) & rl::RL_FEATURE_MULTISCATTER, 0u) << name;
  }
}

TEST(FeatureScan, RoughReflection) {
  EXPECT_FALSE(hasRoughReflection(square(kGray)));
  rl::Material m = kGray;
  m.metallic = 1.0f;
  m.roughness = 0.5f;
  EXPECT_TRUE(hasRoughReflection(square(m)));
  Scene unseen = square(m);
  unseen.instances.clear();
  EXPECT_FALSE(hasRoughReflection(unseen)) << "nothing uses it";
  m.roughness = 0.0f;
  EXPECT_FALSE(hasRoughReflection(square(m))) << "a mirror loses nothing";
  m.metallic = 0.0f;
  m.roughness = 0.5f;
  m.specular = 1.0f;
  m.specularColor = glm::vec3(1.0f);
  m.ior = 1.5f;
  EXPECT_TRUE(hasRoughReflection(square(m))) << "a coat";
  m.transmission = 0.5f;
  EXPECT_FALSE(hasRoughReflection(square(m))) << "rough glass is not compensated";
  m.transmission = 0.0f;
  m.flags |= rl::RL_MATERIAL_BLACK;
  EXPECT_FALSE(hasRoughReflection(square(m)));
}

}  // namespace
}  // namespace restlab
