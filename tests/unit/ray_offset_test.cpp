// Ray offsets without a constant epsilon: no surface shadows itself, no closed mesh leaks, and
// mutually visible points stay visible, over eight decades of size and distance from the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

rl::Ray pathRay(const glm::vec3& origin, const glm::vec3& dir) {
  rl::Ray ray;
  ray.origin = origin;
  ray.tMin = 0.0f;
  ray.dir = dir;
  ray.tMax = 3e38f;
  return ray;
}

// Directions over the whole sphere, most of them close to the plane of the surface.
glm::vec3 leavingDirection(Inputs& inputs, const glm::vec3& n) {
  const glm::vec3 d = inputs.direction();
  const float lift = inputs.below(2) == 0 ? 1.0f : inputs.scale(1e-6f, 1.0f);
  const glm::vec3 flat = d - n * (glm::dot(n, d) * (1.0f - lift));
  return glm::vec3(glm::normalize(glm::dvec3(flat)));
}

// Aims at points of random triangles from all around, leaves each hit in four directions, and
// counts the rays that hit the triangle they start from.
template <typename PointOf>
uint64_t countSelfHits(Dialect<>& d, Inputs& inputs, uint32_t aims, const PointOf& pointOf,
                       uint64_t& left) {
  uint64_t selfHits = 0;
  for (uint32_t i = 0; i < aims; ++i) {
    float size = 0.0f;
    const glm::vec3 target = pointOf(i, size), dir = inputs.direction();
    rl::Hit hit;
    d->traceRay(pathRay(target - dir * (size * inputs.scale(1e-2f, 10.0f)), dir), rl::RL_RAY_PATH,
                0, hit);
    if (hit.instance == rl::RL_INVALID) continue;
    const rl::Surface s = d->surfaceLoad(hit, dir);
    for (int k = 0; k < 4; ++k) {
      const glm::vec3 out = leavingDirection(inputs, s.nGeoW);
      rl::Hit next;
      d->traceRay(pathRay(d->surfaceOffset(s.posW, s.nGeoW, s.posError, out), out), rl::RL_RAY_PATH,
                  0, next);
      ++left;
      if (next.instance == hit.instance && next.primitive == hit.primitive) ++selfHits;
    }
  }
  return selfHits;
}

// 100,000 triangles of sizes 1e-4 .. 1e4 at distances 1e-4 .. 1e4 (as far as float can distinguish
// their corners).
TEST(RayOffset, NoTriangleHitsItself) {
  Inputs inputs(1);
  uint64_t left = 0, selfHits = 0;
  for (int batch = 0; batch < 20; ++batch) {
    MeshGeometry mesh;
    std::vector<float> sizes;
    while (mesh.triangles.size() < 5000) {
      const float distance = inputs.scale(1e-4f, 1e4f), size = inputs.scale(1e-4f, 1e4f);
      const glm::vec3 center = distance * inputs.direction();
      glm::vec3 p[3];
      for (glm::vec3& corner : p) corner = center + size * inputs.direction() * inputs.uniform();
      const glm::dvec3 e1 = glm::dvec3(p[1]) - glm::dvec3(p[0]),
                       e2 = glm::dvec3(p[2]) - glm::dvec3(p[0]);
      if (size < 1e-5f * distance || !(glm::length(glm::cross(e1, e2)) > 0.0)) continue;
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), p, p + 3);
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      sizes.push_back(size);
    }
    builtin::SceneBuilder builder("soup");
    builder.add(mesh, builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f))));
    Dialect<> d(CompiledScene::build(builder.finish()));
    const glm::vec3 origin(d.compiledScene->origin());
    selfHits += countSelfHits(
        d, inputs, 5000,
        [&](uint32_t i, float& size) {
          const float u = inputs.uniform(), v = inputs.uniform() * (1.0f - u);
          size = sizes[i];
          const glm::vec3* p = &mesh.positions[3 * size_t(i)];
          return p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]) - origin;
        },
        left);
  }
  EXPECT_GT(left, 300'000u);
  EXPECT_EQ(selfHits, 0u) << "of " << left;
}

// Instances: transforming the ray to the mesh adds rounding of its own.
TEST(RayOffset, NoInstanceHitsItself) {
  Inputs inputs(2);
  uint64_t left = 0, selfHits = 0;
  for (int batch = 0; batch < 10; ++batch) {
    builtin::SceneBuilder builder("instances");
    const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
    const uint32_t mesh = builder.addGeometry(builtin::sphere("ball", {0, 0, 0}, 1.0, 2, false));
    std::vector<glm::dvec3> centers;
    std::vector<float> sizes;
    for (int i = 0; i < 200; ++i) {
      const float distance = inputs.scale(1e-2f, 1e4f),
                  size = std::max(inputs.scale(1e-3f, 1e3f), 1e-3f * distance);
      const glm::dvec3 at = double(distance) * glm::dvec3(inputs.direction());
      glm::dmat4 m = glm::translate(glm::dmat4(1.0), at);
      m = glm::rotate(m, 6.28 * inputs.uniform(), glm::dvec3(inputs.direction()));
      const glm::dvec3 stretch(inputs.scale(0.2f, 1.0f), inputs.scale(0.2f, 1.0f),
                               inputs.below(2) == 0 ? -1.0 : 1.0);
      builder.place("ball", mesh, id, glm::scale(m, double(size) * stretch));
      centers.push_back(at);
      sizes.push_back(size);
    }
    Dialect<> d(CompiledScene::build(builder.finish()));
    selfHits += countSelfHits(
        d, inputs, 4000,
        [&](uint32_t i, float& size) {
          const size_t k = i % centers.size();
          size = 3.0f * sizes[k];
          return glm::vec3(centers[k] - d.compiledScene->origin()) +
                 0.3f * sizes[k] * inputs.direction();
        },
        left);
  }
  EXPECT_GT(left, 100'000u);
  EXPECT_EQ(selfHits, 0u) << "of " << left;
}

struct ClosedMesh {
  std::string name;
  std::shared_ptr<const CompiledScene> scene;
  glm::vec3 center;
};

// Makes a closed convex mesh of a given size, off the origin: a small box on the other side keeps
// the scene's centre at the origin.
ClosedMesh closedMesh(bool isBox, double size, const glm::dvec3& at) {
  builtin::SceneBuilder builder("closed");
  const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.add(isBox ? builtin::box("box", at - size * glm::dvec3(0.5, 0.3, 0.9),
                                   at + size * glm::dvec3(0.6, 0.7, 0.2))
                    : builtin::sphere("ball", at, size, 3, true),
              id);
  if (const double distance = glm::length(at); distance > 0.0) {
    const glm::dvec3 there = -at * (1.0 + 4.0 * size / distance), h(0.01 * size);
    builder.add(builtin::box("counterweight", there - h, there + h), id);
  }
  ClosedMesh mesh;
  mesh.name = (isBox ? "box of " : "ball of ") + std::to_string(size) + " at " +
              std::to_string(glm::length(at));
  mesh.scene = CompiledScene::build(builder.finish());
  mesh.center = glm::vec3(at - mesh.scene->origin());
  return mesh;
}

std::vector<ClosedMesh> closedMeshes() {
  std::vector<ClosedMesh> meshes;
  for (const bool isBox : {true, false}) {
    for (double size : {1e-4, 1e-2, 1.0, 1e2, 1e4}) {
      for (double distance : {0.0, 1.0, 1e2, 1e4}) {
        // The offset is 2e-6 of the distance and must be small relative to the mesh.
        if (size < 1e-3 * distance) continue;
        meshes.push_back(closedMesh(isBox, size, distance * glm::dvec3(0.48, -0.6, 0.64)));
      }
    }
  }
  return meshes;
}

TEST(RayOffset, ClosedMeshesDoNotLeak) {
  for (const ClosedMesh& mesh : closedMeshes()) {
    Dialect<> d(mesh.scene);
    Inputs inputs(3);
    uint64_t leaks = 0;
    rl::Ray ray = pathRay(mesh.center, inputs.direction());
    for (int bounce = 0; bounce < 200'000; ++bounce) {
      rl::Hit hit;
      d->traceRay(ray, rl::RL_RAY_PATH, 0, hit);
      if (hit.instance != 0u) {  // a miss, or the counterweight
        ++leaks;
        ray = pathRay(mesh.center, inputs.direction());
        continue;
      }
      const rl::Surface s = d->surfaceLoad(hit, ray.dir);
      glm::vec3 out = leavingDirection(inputs, s.nGeoW);
      if (glm::dot(out, s.nGeoW) < 0.0f) out = -out;
      ray = pathRay(d->surfaceOffset(s.posW, s.nGeoW, s.posError, out), out);
    }
    EXPECT_EQ(leaks, 0u) << mesh.name;
  }
}

// All pairs of points inside a convex mesh see each other; the shadow ray is shortened at both
// ends.
TEST(RayOffset, ConvexMeshesDoNotShadowThemselves) {
  for (const ClosedMesh& mesh : closedMeshes()) {
    Dialect<> d(mesh.scene);
    Inputs inputs(4);
    uint64_t blocked = 0, pairs = 0;
    for (int i = 0; i < 100'000; ++i) {
      rl::Surface ends[2];
      bool isInside = true;
      for (rl::Surface& end : ends) {
        const glm::vec3 dir = inputs.direction();
        rl::Hit hit;
        d->traceRay(pathRay(mesh.center, dir), rl::RL_RAY_PATH, 0, hit);
        isInside = isInside && hit.instance == 0u;
        if (isInside) end = d->surfaceLoad(hit, dir);
      }
      ASSERT_TRUE(isInside);
      if (glm::dot(ends[0].nGeoW, ends[1].nGeoW) > 0.9999f) continue;  // both on one plane
      rl::LightSample target{};
      target.kind = rl::RL_LIGHT_AREA;
      target.point = ends[1].posW;
      target.normal = ends[1].nGeoW;
      target.posError = ends[1].posError;
      target.pdf = 1.0f;
      target.radiance = glm::vec3(1.0f);
      const rl::LightConnection c = d->lightConnect(target, ends[0].posW);
      const rl::Ray ray =
          d->lightShadowRay(target, c, ends[0].posW, ends[0].nGeoW, ends[0].posError);
      rl::Hit hit;
      ++pairs;
      if (d->traceRay(ray, rl::RL_RAY_SHADOW, 0, hit) != 1.0f) ++blocked;
    }
    EXPECT_GT(pairs, 50'000u);
    EXPECT_EQ(blocked, 0u) << mesh.name << ", of " << pairs;
  }
}

// The lamp's end of a shadow ray carries the error of its instance's transform: a mesh modelled far
// from its own origin and moved back by its nodes must not shadow itself.
TEST(RayOffset, LampsOfInstancesAreSeen) {
  constexpr int kLamps = 64;
  for (const double offset : {0.0, 16.0, 1024.0, 16384.0}) {
    builtin::SceneBuilder builder("lamps");
    const glm::dvec3 far = offset * glm::dvec3(0.6, 0.5, -0.7);
    const uint32_t lamp = builder.addMaterial("lamp", builtin::lamp(glm::vec3(1.0f)));
    const uint32_t mesh = builder.addGeometry(builtin::quad(
        "quad", far - glm::dvec3(0.1, 0.1, 0), glm::dvec3(0.2, 0, 0), glm::dvec3(0, 0.2, 0)));
    // Lamps all around the receiver, each facing it, none in front of another.
    for (int i = 0; i < kLamps; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kLamps, angle = 2.4 * i;
      const glm::dvec3 at = 3.0 * glm::dvec3(std::sqrt(1.0 - z * z) * std::cos(angle),
                                             std::sqrt(1.0 - z * z) * std::sin(angle), z);
      const glm::dmat4 m =  // view along -z, so that +z faces the receiver
          glm::inverse(glm::lookAt(at, 2.0 * at, glm::dvec3(0.1, 0.9, 0.2)));
      builder.place("lamp", mesh, lamp, glm::translate(m, -far));
    }
    Dialect<> d(CompiledScene::build(builder.finish()));
    const auto receiver = glm::vec3(-d.compiledScene->origin());
    uint64_t faces = 0, blocked = 0;
    for (uint32_t i = 0; i < 20'000; ++i) {
      const rl::LightSample s = d->lightSample(d->rngInit(5, i, 0), anyReceiver());
      const rl::LightConnection c = d->lightConnect(s, receiver);
      if (c.geometry > 0.0f) ++faces;
      const rl::Ray ray = d->lightShadowRay(s, c, receiver, glm::vec3(0, 1, 0), 0.0f);
      rl::Hit hit;
      if (d->traceRay(ray, rl::RL_RAY_SHADOW, 0, hit) != 1.0f) ++blocked;
    }
    EXPECT_EQ(faces, 20'000u) << "offset " << offset;
    EXPECT_EQ(blocked, 0u) << "offset " << offset;
  }
}

// Conversely, an offset must not jump over an existing surface.
TEST(RayOffset, ThinWallsStillBlock) {
  for (double thickness : {1e-3, 1e-4}) {
    builtin::SceneBuilder builder("sheet");
    const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
    builder.add(builtin::box("sheet", {-1, -1, 0}, {1, 1, thickness}), id);
    Dialect<> d(CompiledScene::build(builder.finish()));
    Inputs inputs(5);
    for (int i = 0; i < 10'000; ++i) {
      const glm::vec3 from(inputs.uniform(-0.9f, 0.9f), inputs.uniform(-0.9f, 0.9f), 1.0f);
      rl::Hit hit;
      d->traceRay(pathRay(from, {0, 0, -1}), rl::RL_RAY_PATH, 0, hit);
      ASSERT_NE(hit.instance, rl::RL_INVALID);
      const rl::Surface s = d->surfaceLoad(hit, {0, 0, -1});
      // A ray into the sheet must hit its other side from inside.
      rl::Hit next;
      const glm::vec3 in(0, 0, -1);
      d->traceRay(pathRay(d->surfaceOffset(s.posW, s.nGeoW, s.posError, in), in), rl::RL_RAY_PATH,
                  0, next);
      ASSERT_NE(next.instance, rl::RL_INVALID) << thickness;
      ASSERT_NE(next.primitive, hit.primitive);
    }
  }
}

}  // namespace
}  // namespace restlab::unit
