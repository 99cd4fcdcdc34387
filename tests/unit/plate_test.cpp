// Closed meshes below a scale of 0 along one axis: plates with a front on either side, baked and as
// instances, by Embree and by the project's own hierarchy.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/plate.h"
#include "tests/unit/bvh_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

constexpr double kTrace = 1e-10;  // scale that an import leaves of the flattened axis

// Smooth balls of 2 m that emit, flattened along their own Y, under `matrix`; the second one is far
// off, so that coordinates are large.
std::shared_ptr<const CompiledScene> plates(const glm::dmat4& matrix, bool shared) {
  builtin::SceneBuilder builder("plates");
  const uint32_t id = builder.addMaterial("lamp", builtin::lamp(glm::vec3(1.0f)));
  const MeshGeometry ball = builtin::sphere("ball", {0, 0.2, 0}, 1.0, 3, true);
  const uint32_t mesh = builder.addGeometry(ball);
  const glm::dmat4 flat = matrix * glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, kTrace, 1.0));
  builder.place("one", mesh, id, flat);
  const glm::dmat4 away = glm::translate(glm::dmat4(1.0), glm::dvec3(30.0, 5.0, -8.0));
  builder.place("two", shared ? mesh : builder.addGeometry(ball), id, away * flat);
  return CompiledScene::build(builder.finish());
}

TEST(Plates, HaveAFrontOnEitherSide) {
  const glm::dmat4 one(1.0);
  const glm::dmat4 turned =
      glm::translate(one, glm::dvec3(1, 2, -3)) * glm::rotate(one, 0.7, glm::dvec3(0.3, 1.0, -0.2));
  Inputs inputs(1);
  for (const glm::dmat4& matrix :
       {one, turned, turned * glm::scale(one, glm::dvec3(-0.5, 1.0, 2.0))}) {
    for (const bool shared : {false, true}) {
      Dialect<> d(plates(matrix, shared));
      d.compiledScene->bindBvh();
      const glm::dvec3 normal =
          glm::normalize(glm::cross(glm::dvec3(matrix[2]), glm::dvec3(matrix[0])));
      rl::CpuKernelCounters counters{};
      const rl::FrameData frame{};
      rl::BvhCtx own{d.compiledScene->data(), frame, counters};
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 at(1.4 * inputs.uniform() - 0.7, 0.0, 1.4 * inputs.uniform() - 0.7);
        if (glm::length(at) > 0.9) continue;
        const glm::dvec3 target(matrix * glm::dvec4(at, 1.0));
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const glm::vec3 dir = glm::normalize(-side * normal + 0.4 * glm::dvec3(inputs.direction()));
        rl::Ray ray;
        ray.origin = glm::vec3(target - d.compiledScene->origin()) - 5.0f * dir;
        ray.dir = dir;
        ray.tMin = 0.0f;
        ray.tMax = 3e38f;
        rl::Hit hit, other;
        d->traceRay(ray, rl::RL_RAY_PATH, 0, hit);
        own.traceRay(ray, rl::RL_RAY_PATH, 0, other);
        ASSERT_EQ(hit.instance, 0u);
        ASSERT_EQ(other.instance, 0u);
        EXPECT_NEAR(hit.t, 5.0f, 1e-3f);
        EXPECT_NEAR(other.t, hit.t, 1e-4f);
        const rl::Surface s = d->surfaceLoad(hit, dir);
        ASSERT_GT(glm::dot(glm::dvec3(s.nGeoW), side * normal), 0.999);
        ASSERT_GT(glm::dot(glm::dvec3(s.nShadeW), side * normal), 0.99);
        EXPECT_EQ(s.emission, glm::vec3(1.0f)) << "the side that it shows is its front";
        ++hits;
      }
      EXPECT_GT(hits, 1000);
    }
  }
}

TEST(Plates, AreAsThinAsRaysAllow) {
  const auto scene = plates(glm::dmat4(1.0), false);
  const MeshGeometry& ball = scene->source().geometries[0];
  glm::dmat4 flat = scene->source().instances[0].objectToWorld;
  flat[3] -= glm::dvec4(scene->origin(), 0.0);
  const glm::dmat4 thick = withThickness(flat, ball);
  const double thickness = 2.0 * thick[1].y;
  EXPECT_GT(thickness, 4.0 * rl::RL_HIT_ERROR * 15.0);
  EXPECT_LT(thickness, 16.0 * rl::RL_HIT_ERROR * 17.0);
  EXPECT_NEAR((thick * glm::dvec4(0.0, 0.2, 0.0, 1.0)).y, flat[3].y, 1e-9) << "its middle stays";
  // Thin meshes that are not flat stay unchanged.
  const glm::dmat4 thin = glm::scale(glm::dmat4(1.0), glm::dvec3(1e3, 1e-4, 1.0));
  EXPECT_EQ(withThickness(thin, ball), thin);
}

}  // namespace
}  // namespace restlab::unit
