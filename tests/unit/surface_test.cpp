// surfaceLoad on hand-made scenes: interpolation, sides, textures, normal maps, emission, alpha.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

using builtin::SceneBuilder;

const glm::vec3 kDown(0.0f, 0.0f, -1.0f);

// A unit right triangle in the plane z = 0 that faces +z, with every attribute.
MeshGeometry fullTriangle() {
  MeshGeometry mesh;
  mesh.name = "triangle";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}};
  mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 0.5f}, {0, 0, 1, 0}};
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
  mesh.uvs[1] = {{0.5f, 0.25f}, {0.5f, 0.75f}, {0, 0.25f}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// Adds an image and a use of it; returns the index of the use.
uint32_t addTexture(Scene& scene, uint32_t width, uint32_t height, std::vector<uint32_t> texels,
                    uint32_t uvSet = 0) {
  TextureImage image;
  image.width = width;
  image.height = height;
  image.texels = std::move(texels);
  scene.images.push_back(image);
  TextureUse use;
  use.image = static_cast<uint32_t>(scene.images.size() - 1);
  use.uvSet = uvSet;
  use.nearest = true;
  scene.textureUses.push_back(use);
  return static_cast<uint32_t>(scene.textureUses.size() - 1);
}

Scene sceneOf(const MeshGeometry& mesh, const rl::Material& material) {
  SceneBuilder builder("hand-made");
  builder.add(mesh, builder.addMaterial("material", material));
  return builder.finish();
}

rl::Surface load(Dialect<>& d, const glm::vec2& bary, const glm::vec3& rayDir = kDown) {
  return d->surfaceLoad({0, 0, bary, 1.0f}, rayDir);
}

TEST(Surface, InterpolatesByBarycentricCoordinates) {
  Dialect<> d(CompiledScene::build(sceneOf(fullTriangle(), builtin::lambert(glm::vec3(0.5f)))));
  const glm::dvec3 origin = d.compiledScene->origin();
  Inputs inputs(1);
  for (int i = 0; i < 1000; ++i) {
    const float u = inputs.uniform(), v = inputs.uniform() * (1.0f - u), w = 1.0f - u - v;
    const rl::Surface s = load(d, {u, v});
    ASSERT_LT(glm::distance(glm::dvec3(s.posW) + origin, glm::dvec3(u, v, 0.0)), 1e-6);
    ASSERT_EQ(s.nGeoW, glm::vec3(0, 0, 1));
    const glm::vec3 n = glm::normalize(glm::vec3(0.6f * u, 0.6f * v, w + 0.8f * (u + v)));
    ASSERT_LT(glm::distance(s.nShadeW, n), 1e-6f);
    // Vertex colours are linear and multiply the base colour.
    ASSERT_LT(glm::distance(s.bsdf.diffuse, 0.5f * glm::vec3(w, u, v)), 1e-6f);
    ASSERT_EQ(s.wo, -kDown);
    ASSERT_GT(s.posError, 0.0f);
    ASSERT_LT(s.posError, 1e-5f);
  }
}

TEST(Surface, NormalsTurnToTheViewer) {
  Dialect<> d(CompiledScene::build(sceneOf(fullTriangle(), builtin::lambert(glm::vec3(0.5f)))));
  Inputs inputs(2);
  for (int i = 0; i < 10'000; ++i) {
    const glm::vec3 dir = inputs.direction();
    const rl::Surface s = load(d, {0.3f, 0.3f}, dir);
    ASSERT_GE(glm::dot(s.nGeoW, s.wo), 0.0f);
    ASSERT_GT(glm::dot(s.nShadeW, s.nGeoW), 0.0f);
    ASSERT_NEAR(glm::length(s.nShadeW), 1.0f, 1e-5f);
  }
}

// A vertex normal on the far side of its face is mirrored to the near side, and stays a unit
// vector.
TEST(Surface, ImpossibleShadingNormals) {
  MeshGeometry mesh = fullTriangle();
  for (const glm::vec3 n :
       {glm::vec3(0.6f, 0, -0.8f), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(0, 0, 0)}) {
    mesh.normals = {n, n, n};
    Dialect<> d(CompiledScene::build(sceneOf(mesh, builtin::lambert(glm::vec3(0.5f)))));
    const rl::Surface s = load(d, {0.3f, 0.3f});
    EXPECT_GT(glm::dot(s.nShadeW, s.nGeoW), 0.0f);
    EXPECT_NEAR(glm::length(s.nShadeW), 1.0f, 1e-5f);
  }
}

// Reuse evaluates a stored vertex for other directions: the normal may depend only on the visible
// side of the face, not otherwise on the direction. (inconsistent_normal.glsl turns normals that wo
// sees from behind, at every evaluation.)
TEST(Surface, ShadingNormalsAreThoseOfASide) {
  MeshGeometry mesh = fullTriangle();
  mesh.normals = {{0.9f, 0, 0.3f}, {0, 0.9f, 0.1f}, {0.9f, -0.5f, 0.2f}};
  Dialect<> d(CompiledScene::build(sceneOf(mesh, builtin::metal(glm::vec3(0.9f), 0.3f))));
  Inputs inputs(3);
  for (const float side : {1.0f, -1.0f}) {
    const glm::vec3 expected = load(d, {0.3f, 0.3f}, side * kDown).nShadeW;
    int fromBehind = 0;
    for (int i = 0; i < 1000; ++i) {
      const rl::Surface s = load(d, {0.3f, 0.3f}, inputs.directionAbove(side * kDown));
      ASSERT_EQ(s.nShadeW, expected);
      fromBehind += glm::dot(s.nShadeW, s.wo) < 0.0f;
    }
    EXPECT_GT(fromBehind, 100);
  }
}

TEST(Surface, EmissionHasSides) {
  for (const bool twoSided : {false, true}) {
    rl::Material lamp = builtin::lamp(glm::vec3(3.0f, 2.0f, 1.0f));
    if (twoSided) lamp.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    Dialect<> d(CompiledScene::build(sceneOf(fullTriangle(), lamp)));
    EXPECT_EQ(load(d, {0.2f, 0.2f}).emission, glm::vec3(3.0f, 2.0f, 1.0f));
    EXPECT_EQ(load(d, {0.2f, 0.2f}, -kDown).emission,
              twoSided ? glm::vec3(3.0f, 2.0f, 1.0f) : glm::vec3(0.0f));
    EXPECT_EQ(load(d, {0.2f, 0.2f}).light, 0u);
    EXPECT_EQ(load(d, {0.2f, 0.2f}).bsdf.lobes, 0u);
  }
}

TEST(Surface, UnlitShowsItsColourOnBothSides) {
  rl::Material unlit = builtin::lambert(glm::vec3(0.25f, 0.5f, 1.0f));
  unlit.flags = rl::RL_MATERIAL_UNLIT;
  MeshGeometry mesh = fullTriangle();
  mesh.colors.clear();
  Dialect<> d(CompiledScene::build(sceneOf(mesh, unlit)));
  for (const glm::vec3& dir : {kDown, -kDown}) {
    EXPECT_EQ(load(d, {0.2f, 0.2f}, dir).emission, glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(load(d, {0.2f, 0.2f}, dir).bsdf.lobes, 0u);
  }
  EXPECT_EQ(load(d, {0.2f, 0.2f}).light, rl::RL_INVALID);
}

// Traversal aborts on non-finite rays: no triangle, however small, may produce one.
TEST(Surface, TinyTrianglesHaveANormal) {
  MeshGeometry mesh = fullTriangle();
  mesh.normals.clear();
  for (const float size : {1e-3f, 1e-9f, 1e-12f, 1e-20f, 1e-38f, 0.0f}) {
    mesh.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    Dialect<> d(CompiledScene::build(sceneOf(mesh, builtin::lambert(glm::vec3(0.5f)))));
    const rl::Surface s = load(d, {0.3f, 0.3f});
    EXPECT_NEAR(glm::length(s.nGeoW), 1.0f, 1e-5f) << size;
    EXPECT_NEAR(glm::length(s.nShadeW), 1.0f, 1e-5f) << size;
    EXPECT_TRUE(std::isfinite(s.posW.x + s.posW.y + s.posW.z)) << size;
  }
}

// Each slot reads its own channels, from its own UV set.
TEST(Surface, TextureSlots) {
  rl::Material m = builtin::plastic(glm::vec3(0.8f), 0.9f);
  m.metallic = 0.5f;
  m.transmission = 0.6f;
  m.emission = glm::vec3(2.0f);
  Scene scene = sceneOf(fullTriangle(), m);
  scene.geometries[0].colors.clear();
  rl::Material& material = scene.materials[0].data;
  auto rgba = [](uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
    return r | g << 8 | b << 16 | a << 24;
  };
  material.textures[rl::RL_TEX_BASE_COLOR] = addTexture(scene, 1, 1, {rgba(255, 102, 51, 255)});
  material.textures[rl::RL_TEX_METALLIC_ROUGHNESS] =
      addTexture(scene, 1, 1, {rgba(9, 102, 204, 7)});
  material.textures[rl::RL_TEX_EMISSIVE] = addTexture(scene, 1, 1, {rgba(51, 102, 153, 3)});
  material.textures[rl::RL_TEX_TRANSMISSION] = addTexture(scene, 1, 1, {rgba(127, 5, 6, 8)});
  material.textures[rl::RL_TEX_SPECULAR] = addTexture(scene, 1, 1, {rgba(1, 2, 3, 153)});
  material.textures[rl::RL_TEX_SPECULAR_COLOR] = addTexture(scene, 1, 1, {rgba(255, 127, 51, 4)});
  Dialect<> d(CompiledScene::build(std::move(scene)));
  const rl::Surface s = load(d, {0.2f, 0.3f});
  const float metallic = 0.5f * 0.8f, roughness = 0.9f * 0.4f,
              transmission = 0.6f * 127.0f / 255.0f, specular = 0.6f;
  const glm::vec3 base(0.8f, 0.32f, 0.16f);
  EXPECT_NEAR(s.bsdf.alpha, roughness * roughness, 1e-6f);
  EXPECT_LT(glm::distance(s.bsdf.diffuse, base * (1 - metallic) * (1 - transmission)), 1e-6f);
  EXPECT_LT(glm::distance(s.bsdf.transmission, base * (1 - metallic) * transmission), 1e-6f);
  EXPECT_LT(glm::distance(s.emission, 2.0f * glm::vec3(0.2f, 0.4f, 0.6f)), 1e-6f);
  const glm::vec3 f0 = 0.04f * specular * glm::vec3(1.0f, 127.0f / 255.0f, 0.2f);
  EXPECT_LT(glm::distance(s.bsdf.f0, f0 * (1 - metallic) + base * metallic), 1e-6f);
  EXPECT_NEAR(s.bsdf.f90, specular * (1 - metallic) + metallic, 1e-6f);
}

TEST(Surface, UvSetsAreKeptApart) {
  Scene scene = sceneOf(fullTriangle(), builtin::lambert(glm::vec3(1.0f)));
  scene.geometries[0].colors.clear();
  // Set 1 covers v in 0.25 .. 0.75, u in 0 .. 0.5: only the left texels of the two rows.
  const uint32_t use =
      addTexture(scene, 2, 2, {0xff0000ffu, 0xffffffffu, 0xff00ff00u, 0xffffffffu}, 1);
  scene.materials[0].data.textures[rl::RL_TEX_BASE_COLOR] = use;
  Dialect<> d(CompiledScene::build(std::move(scene)));
  EXPECT_EQ(load(d, {0.1f, 0.2f}).bsdf.diffuse, glm::vec3(1, 0, 0));
  EXPECT_EQ(load(d, {0.7f, 0.2f}).bsdf.diffuse, glm::vec3(0, 1, 0));
}

TEST(Surface, NormalMapOfUpIsTheIdentity) {
  MeshGeometry mesh = fullTriangle();
  for (const bool hasTangents : {false, true}) {
    if (hasTangents) mesh.tangents = {{1, 0, 0, 1}, {0.8f, 0, -0.6f, 1}, {1, 0, 0, 1}};
    rl::Material m = builtin::lambert(glm::vec3(0.5f));
    Scene plain = sceneOf(mesh, m);
    Scene mapped = plain;
    // Exactly up would be 127.5: 128 is off by 1/255.
    mapped.materials[0].data.textures[rl::RL_TEX_NORMAL] = addTexture(mapped, 1, 1, {0xffff8080u});
    Dialect<> a(CompiledScene::build(std::move(plain))), b(CompiledScene::build(std::move(mapped)));
    for (const glm::vec2 bary : {glm::vec2(0.2f, 0.3f), glm::vec2(0.7f, 0.1f)}) {
      for (const glm::vec3& dir : {kDown, -kDown}) {
        EXPECT_LT(glm::distance(load(a, bary, dir).nShadeW, load(b, bary, dir).nShadeW), 0.006f);
      }
    }
  }
}

// Red is along +u, green up in the image, against v; both with and without stored tangents.
TEST(Surface, NormalMapDirections) {
  for (const bool hasTangents : {false, true}) {
    MeshGeometry mesh = fullTriangle();
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    // u to the right, v downwards: the image stands upright on the triangle.
    mesh.uvs[0] = {{0, 1}, {1, 1}, {0, 0}};
    if (hasTangents) mesh.tangents = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
    for (const bool isRed : {true, false}) {
      Scene scene = sceneOf(mesh, builtin::lambert(glm::vec3(0.5f)));
      const uint32_t texel =
          isRed ? 0xffda80dau : 0xffdada80u;  // (0.71, 0, 0.71) and (0, 0.71, 0.71)
      scene.materials[0].data.textures[rl::RL_TEX_NORMAL] = addTexture(scene, 1, 1, {texel});
      Dialect<> d(CompiledScene::build(std::move(scene)));
      const float h = std::sqrt(0.5f);
      const glm::vec3 expected = isRed ? glm::vec3(h, 0, h) : glm::vec3(0, h, h);
      EXPECT_LT(glm::distance(load(d, {0.2f, 0.2f}).nShadeW, expected), 0.01f)
          << hasTangents << isRed;
      EXPECT_LT(glm::distance(load(d, {0.2f, 0.2f}, -kDown).nShadeW, -expected), 0.01f);
    }
  }
}

TEST(Surface, AlphaOfMaskAndBlend) {
  rl::Material m = builtin::lambert(glm::vec3(0.5f));
  m.alpha = 0.8f;
  m.alphaCutoff = 0.3f;
  for (const uint32_t flag : {0u, rl::RL_MATERIAL_ALPHA_MASK, rl::RL_MATERIAL_ALPHA_BLEND}) {
    m.flags = flag;
    Scene scene = sceneOf(fullTriangle(), m);
    scene.materials[0].data.textures[rl::RL_TEX_BASE_COLOR] =
        addTexture(scene, 1, 1, {0xccffffffu});
    Dialect<> d(CompiledScene::build(std::move(scene)));
    for (const glm::vec2 bary :
         {glm::vec2(0.1f, 0.1f), glm::vec2(0.1f, 0.6f), glm::vec2(0.5f, 0.5f)}) {
      const float coverage = 0.8f * 0.8f * (1.0f - 0.5f * bary.x - bary.y);
      float expected = 1.0f;
      if (flag == rl::RL_MATERIAL_ALPHA_MASK) expected = coverage < 0.3f ? 0.0f : 1.0f;
      if (flag == rl::RL_MATERIAL_ALPHA_BLEND) expected = coverage;
      EXPECT_NEAR(d->surfaceAlpha({0, 0, bary, 1.0f}), expected, 1e-5f) << flag;
    }
  }
}

}  // namespace
}  // namespace restlab::unit
