// Instances: a mesh shared through a transform shades like the mesh baked into world space,
// mirrored or not.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

struct TransformCase {
  const char* name;
  glm::dmat4 matrix;
};

std::vector<TransformCase> transforms() {
  const glm::dmat4 one(1.0);
  const glm::dmat4 turn = glm::rotate(one, 0.7, glm::dvec3(0.3, 1.0, -0.2));
  return {{"translation", glm::translate(one, glm::dvec3(3, -2, 5))},
          {"rotation", turn},
          {"non-uniform scale", turn * glm::scale(one, glm::dvec3(0.3, 2.0, 1.1))},
          {"mirror", glm::scale(one, glm::dvec3(-1, 1, 1))},
          {"mirror, turned and stretched", glm::translate(one, glm::dvec3(1, 2, 3)) * turn *
                                               glm::scale(one, glm::dvec3(1.5, -0.4, 2.0))},
          {"shear", glm::dmat4(1, 0, 0, 0, 0.7, 1, 0, 0, 0, -0.4, 1, 0, 0, 0, 0, 1)},
          {"inverted", glm::scale(one, glm::dvec3(-1, -1, -1))}};
}

// A bumpy patch with normals, UVs and, on request, tangents.
MeshGeometry patch(bool hasTangents) {
  MeshGeometry mesh;
  mesh.name = "patch";
  for (int y = 0; y <= 3; ++y) {
    for (int x = 0; x <= 3; ++x) {
      const float u = float(x) / 3.0f, v = float(y) / 3.0f;
      mesh.positions.emplace_back(u, v, 0.2f * std::sin(3.0f * u) * std::cos(2.0f * v));
      mesh.normals.push_back(glm::normalize(glm::vec3(0.3f * u - 0.1f, 0.4f * v - 0.2f, 1.0f)));
      mesh.uvs[0].emplace_back(0.9f * u + 0.1f * v, 1.0f - v);
      const glm::vec3 t =
          glm::vec3(1, 0.1f, 0) -
          mesh.normals.back() * glm::dot(mesh.normals.back(), glm::vec3(1, 0.1f, 0));
      if (hasTangents) mesh.tangents.emplace_back(glm::normalize(t), 1.0f);
    }
  }
  for (uint32_t y = 0; y < 3; ++y) {
    for (uint32_t x = 0; x < 3; ++x) {
      const uint32_t i = 4 * y + x;
      mesh.triangles.emplace_back(i, i + 1, i + 5);
      mesh.triangles.emplace_back(i, i + 5, i + 4);
    }
  }
  return mesh;
}

// The patch under the transform; `shared` places it twice, which makes both uses instances.
Scene sceneOf(const MeshGeometry& mesh, const glm::dmat4& matrix, bool shared, bool mapped,
              const rl::Material& m) {
  builtin::SceneBuilder builder("instances");
  const uint32_t id = builder.addMaterial("material", m);
  const uint32_t geometry = builder.addGeometry(mesh);
  builder.place("one", geometry, id, matrix);
  const glm::dmat4 away = glm::translate(glm::dmat4(1.0), glm::dvec3(60, 0, 0));
  builder.place("two", shared ? geometry : builder.addGeometry(mesh), id, away);
  Scene scene = builder.finish();
  if (mapped) {
    scene.images.push_back({"bumps", 2, 2, {0xffe0a060u, 0xffd060b0u, 0xffc0c0a0u, 0xfff04080u}});
    scene.textureUses.push_back({});
    scene.materials[0].data.textures[rl::RL_TEX_NORMAL] = 0;
  }
  return scene;
}

rl::Hit trace(Dialect<>& d, const glm::vec3& origin, const glm::vec3& dir) {
  rl::Ray ray;
  ray.origin = origin;
  ray.tMin = 0.0f;
  ray.dir = dir;
  ray.tMax = 3e38f;
  rl::Hit hit;
  d->traceRay(ray, rl::RL_RAY_PATH, 0, hit);
  return hit;
}

void expectSameSurfaces(const TransformCase& c, bool hasTangents, bool mapped) {
  const rl::Material m =
      builtin::lamp(glm::vec3(1.0f));  // one-sided emission shows which side is front
  const MeshGeometry mesh = patch(hasTangents);
  Dialect<> baked(CompiledScene::build(sceneOf(mesh, c.matrix, false, mapped, m)));
  Dialect<> instanced(CompiledScene::build(sceneOf(mesh, c.matrix, true, mapped, m)));
  ASSERT_EQ(baked.compiledScene->triangleCount(), 2 * instanced.compiledScene->triangleCount());
  const glm::dvec3 center =
      glm::dvec3(c.matrix * glm::dvec4(0.5, 0.5, 0.0, 1.0)) - baked.compiledScene->origin();
  Inputs inputs(1);
  int hits = 0, front = 0;
  for (int i = 0; i < 5000; ++i) {
    const glm::vec3 target = glm::vec3(center) + 0.5f * inputs.uniform() * inputs.direction();
    const glm::vec3 dir = inputs.direction(), origin = target - 4.0f * dir;
    const rl::Hit a = trace(baked, origin, dir), b = trace(instanced, origin, dir);
    if (a.instance == rl::RL_INVALID || b.instance == rl::RL_INVALID) continue;  // at an edge
    if (a.primitive != b.primitive) continue;
    const rl::Surface s = baked->surfaceLoad(a, dir), t = instanced->surfaceLoad(b, dir);
    // At grazing angles the rounding of the ray itself, thirty metres off, moves the hit.
    if (std::abs(glm::dot(s.nGeoW, dir)) < 0.2f) continue;
    ++hits;
    ASSERT_EQ(a.instance, b.instance);
    ASSERT_LT(glm::distance(s.posW, t.posW), 3e-5f) << c.name;
    ASSERT_LT(glm::distance(s.nGeoW, t.nGeoW), 1e-4f) << c.name;
    ASSERT_LT(glm::distance(s.nShadeW, t.nShadeW), 2e-3f) << c.name << ", tangents " << hasTangents;
    ASSERT_EQ(s.emission, t.emission) << c.name;
    ASSERT_EQ(s.light, t.light) << c.name;
    if (s.emission.x > 0.0f) ++front;
  }
  EXPECT_GT(hits, 300) << c.name;
  EXPECT_GT(front, 50) << c.name;
}

TEST(Instances, EqualTheBakedMesh) {
  for (const TransformCase& c : transforms()) expectSameSurfaces(c, false, false);
}

TEST(Instances, EqualTheBakedMeshUnderANormalMap) {
  for (const TransformCase& c : transforms()) {
    expectSameSurfaces(c, false, true);
    expectSameSurfaces(c, true, true);
  }
}

// Surface and shading normals of a mirrored instance are the reflections of the original's, with
// and without a normal map.
TEST(Instances, MirroredSurfaceIsTheMirrorImage) {
  const glm::vec3 flip(-1.0f, 1.0f, 1.0f);
  const glm::dmat4 matrix = glm::scale(glm::dmat4(1.0), glm::dvec3(flip));
  const rl::Material m = builtin::lamp(glm::vec3(1.0f));
  for (const bool hasTangents : {false, true}) {
    for (const bool mapped : {false, true}) {
      Dialect<> original(
          CompiledScene::build(sceneOf(patch(hasTangents), glm::dmat4(1.0), true, mapped, m)));
      Dialect<> mirrored(
          CompiledScene::build(sceneOf(patch(hasTangents), matrix, true, mapped, m)));
      Inputs inputs(2);
      for (int i = 0; i < 500; ++i) {
        const float u = inputs.uniform(), v = inputs.uniform() * (1.0f - u);
        const rl::Hit hit{0, inputs.below(18), {u, v}, 1.0f};
        const glm::vec3 dir = inputs.direction();
        const rl::Surface s = original->surfaceLoad(hit, dir),
                          t = mirrored->surfaceLoad(hit, flip * dir);
        ASSERT_LT(glm::distance(s.nGeoW, flip * t.nGeoW), 1e-5f);
        ASSERT_LT(glm::distance(s.nShadeW, flip * t.nShadeW), 1e-4f)
            << "tangents " << hasTangents << ", map " << mapped;
        ASSERT_EQ(s.emission, t.emission);
      }
    }
  }
}

}  // namespace
}  // namespace restlab::unit
