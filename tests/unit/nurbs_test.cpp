// Surfaces of control points that rays meet exactly: they are the surface of the double-precision
// library, a sphere among them is the analytic sphere, and none leaks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/shapes/shape_info.h"
#include "core/scene/splines/closest_point.h"
#include "core/scene/splines/surface_words.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"
#include "tests/unit/shape_cases.h"

namespace restlab::unit {
namespace {

ShapeGeometry surfaceShape(const NurbsSurface& surface) {
  return {findShape("nurbs"), {}, surfaceWords(bezierGrid(surface))};
}

// A sheet with random heights and weights, of any degrees and unequal knots.
NurbsSurface randomSheet(Inputs& inputs, int degreeU, int degreeV, int countU, int countV) {
  const auto axis = [&](int degree, int count) {
    SplineAxis a{degree, count, clampedKnots(degree, count)};
    for (int i = degree + 1; i < count; ++i)
      a.knots[size_t(i)] = (i - degree + 0.5 * double(inputs.uniform())) / (count - degree + 1);
    return a;
  };
  NurbsSurface s{axis(degreeU, countU), axis(degreeV, countV), {}, {}};
  for (int j = 0; j < countV; ++j) {
    for (int i = 0; i < countU; ++i) {
      s.points.emplace_back(2.0 * i / (countU - 1) - 1.0, 2.0 * j / (countV - 1) - 1.0,
                            0.5 * double(inputs.uniform()));
      s.weights.push_back(0.5 + double(inputs.uniform()));
    }
  }
  return s;
}

TEST(NurbsShape, ItsSphereIsTheAnalyticSphere) {
  LocalShape nurbs(surfaceShape(sphereAsNurbs())), sphere({findShape("sphere"), {}, {}});
  Inputs inputs(1);
  int compared = 0;
  for (int i = 0; i < 200'000; ++i) {
    const glm::vec3 dir = inputs.direction();
    glm::vec3 target = 1.05f * inputs.uniform() * inputs.direction();
    if (i % 4 == 1)
      target = glm::vec3(0.0f, 0.0f, inputs.below(2) == 0 ? 1.0f : -1.0f) +
               inputs.scale(1e-7f, 0.1f) * inputs.direction();
    const float away = inputs.below(3) == 0 ? 0.0f : inputs.scale(0.1f, 100.0f);
    const rl::Ray ray = rayOf(target - dir * away, dir * inputs.scale(1e-3f, 1e3f));
    rl::Hit a{}, b{};
    const bool isA = nurbs.d->shapeIntersect(nurbs.shape, ray, a);
    const bool isB = sphere.d->shapeIntersect(sphere.shape, ray, b);
    const float reach = std::max(1.0f, glm::length(ray.origin));
    // Rays that graze, or that begin on the surface, may be told apart by rounding.
    const glm::dvec3 o(ray.origin), d = glm::normalize(glm::dvec3(ray.dir));
    const double nearest = glm::length(o - d * glm::dot(o, d));
    if (std::abs(nearest - 1.0) < 4e-6 * double(reach)) continue;
    if (std::abs(glm::length(ray.origin) - 1.0f) < 3e-6f) continue;
    ASSERT_EQ(isA, isB) << "ray " << i << " passes the centre at " << nearest;
    if (!isA) continue;
    ++compared;
    const double cosine = std::sqrt(std::max(1.0 - nearest * nearest, 1e-12));
    const double error = 2e-6 * double(reach) / cosine;
    ASSERT_NEAR(double(a.t) * double(glm::length(ray.dir)),
                double(b.t) * double(glm::length(ray.dir)), error)
        << "ray " << i;
    const rl::ShapePoint p = nurbs.d->shapePoint(nurbs.shape, {0, a.primitive, a.bary});
    const rl::ShapePoint q = sphere.d->shapePoint(sphere.shape, {0, b.primitive, b.bary});
    ASSERT_LT(double(glm::distance(p.posL, q.posL)), error) << "ray " << i;
    ASSERT_NEAR(glm::length(p.posL), 1.0f, 4e-7f);
    ASSERT_LT(double(glm::distance(p.normalL, p.posL)), 3e-6)
        << p.posL.x << " " << p.posL.y << " " << p.posL.z;
  }
  EXPECT_GT(compared, 100'000);
}

TEST(NurbsShape, ItIsTheSurfaceOfTheLibrary) {
  Inputs inputs(2);
  for (const auto& [p, q] : {std::pair(1, 1), {1, 3}, {3, 3}, {2, 5}, {7, 7}, {4, 1}}) {
    const NurbsSurface s = randomSheet(inputs, p, q, p + 3, q + 2);
    LocalShape local(surfaceShape(s));
    for (int i = 0; i < 3000; ++i) {
      const glm::vec2 at = inputs.square();
      const rl::ShapePoint point = local.d->shapePoint(local.shape, {0, 0, at});
      const SplinePoint is = evaluate(s, double(point.uv.x), double(point.uv.y));
      // uv is rounded: the point moves along the surface.
      const double error = 3e-7 * (2.0 + glm::length(is.du) + glm::length(is.dv));
      ASSERT_LT(glm::distance(glm::dvec3(point.posL), is.position), error) << p << " " << q;
      ASSERT_LT(glm::distance(glm::dvec3(point.normalL), is.normal), 2e-5) << p << " " << q;
      ASSERT_LT(
          glm::length(glm::cross(glm::normalize(glm::dvec3(point.dpdu)), glm::normalize(is.du))),
          2e-5);
    }
  }
}

// Rays that cross a sheet from one side to the other once, also over the edges of its pieces.
TEST(NurbsShape, NoRaySlipsThroughASheet) {
  Inputs inputs(3);
  uint64_t missed = 0, rays = 0;
  for (int sheet = 0; sheet < 12; ++sheet) {
    const int p = 1 + int(inputs.below(5)), q = 1 + int(inputs.below(5));
    const NurbsSurface s = randomSheet(inputs, p, q, p + 1 + int(inputs.below(4)), q + 2);
    LocalShape local(surfaceShape(s));
    const glm::uvec4 head = local.words[0];
    for (int i = 0; i < 40'000; ++i) {
      // Towards a place on the surface: any, on a line of the grid, or at a corner.
      glm::vec2 at = 0.02f + 0.96f * inputs.square();
      if (i % 4 != 0) at.x = float(inputs.below(head.x - 1) + 1) / float(head.x);
      if (i % 4 == 3 && head.y > 1) at.y = float(inputs.below(head.y - 1) + 1) / float(head.y);
      const rl::ShapePoint point = local.d->shapePoint(local.shape, {0, 0, at});
      const float away = inputs.scale(0.1f, 30.0f);
      const glm::vec3 dir = inputs.direction();
      rl::Hit hit{};
      ++rays;
      missed += !local.d->shapeIntersect(local.shape, rayOf(point.posL - dir * away, dir), hit);
    }
  }
  EXPECT_EQ(missed, 0u) << "of " << rays;
}

std::shared_ptr<const CompiledScene> placedSurface(const NurbsSurface& of, const glm::dmat4& m) {
  builtin::SceneBuilder builder("surface");
  const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.place("it", builder.addGeometry(makeShape(surfaceShape(of), "it")), id, m);
  return CompiledScene::build(builder.finish());
}

// Paths inside a closed sphere, of sizes from 2^-13 to 2^17, half of them to poles and seams.
TEST(NurbsShape, NoPathLeavesASphere) {
  Inputs inputs(4);
  uint64_t escaped = 0, rays = 0;
  for (int exponent = -13; exponent <= 17; exponent += 3) {
    const double size = std::exp2(exponent);
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), 3.0 * size * glm::dvec3(0.48, -0.6, 0.64));
    m = glm::scale(glm::rotate(m, 0.7, glm::dvec3(0.3, 0.9, -0.2)),
                   size * glm::dvec3(1.5, 0.7, 1.1));
    const auto scene = placedSurface(sphereAsNurbs(), m);
    Dialect<> d(scene);
    for (int path = 0; path < 10'000; ++path) {
      glm::vec3 at(glm::dvec3(m * glm::dvec4(0.1, 0.05, 0.3, 1.0)) - scene->origin());
      glm::vec3 dir = inputs.direction();
      if (path % 2 == 0) {
        // To a seam, where x is 0 or y is 0, or to a pole.
        glm::dvec3 to(inputs.direction());
        to[int(inputs.below(2))] = 0.0;
        if (path % 4 == 0) to = {0.0, 0.0, path % 8 == 0 ? 1.0 : -1.0};
        to = glm::normalize(to) + 1e-7 * glm::dvec3(inputs.direction());
        dir = glm::normalize(
            glm::vec3(glm::dvec3(m * glm::dvec4(to, 1.0)) - scene->origin() - glm::dvec3(at)));
      }
      for (int bounce = 0; bounce < 10; ++bounce) {
        rl::Hit hit{};
        d->traceRay(rayOf(at, dir), rl::RL_RAY_PATH, 0, hit);
        ++rays;
        if (hit.instance == rl::RL_INVALID) {
          ++escaped;
          break;
        }
        const rl::Surface s = d->surfaceLoad(hit, dir);
        ASSERT_TRUE(std::isfinite(s.nGeoW.x) && std::isfinite(s.posW.x));
        dir = inputs.directionAbove(s.nGeoW);
        // A third of the ways graze.
        if (inputs.below(3) == 0)
          dir = glm::normalize(dir - s.nGeoW * glm::dot(dir, s.nGeoW) *
                                         (1.0f - inputs.scale(1e-5f, 1.0f)));
        if (glm::dot(dir, s.nGeoW) <= 0.0f) break;
        at = d->surfaceOffset(s.posW, s.nGeoW, s.posError, dir);
      }
    }
  }
  EXPECT_GT(rays, 900'000u);
  EXPECT_EQ(escaped, 0u) << "of " << rays;
}

TEST(NurbsShape, InsideIsWhereTheSphereIs) {
  const ShapeGeometry sphere = surfaceShape(sphereAsNurbs());
  ASSERT_TRUE(sphere.info->isClosed(sphere));
  Inputs inputs(6);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 n(inputs.direction());
    EXPECT_TRUE(sphere.info->isInside(sphere, 0.99999 * n));
    EXPECT_FALSE(sphere.info->isInside(sphere, 1.00001 * n));
  }
  EXPECT_TRUE(sphere.info->isInside(sphere, {0.0, 0.0, 0.0}));
  NurbsSurface turned = sphereAsNurbs();
  for (glm::dvec3& p : turned.points) p.z = -p.z;
  EXPECT_FALSE(sphere.info->isClosed(surfaceShape(turned))) << "its outside is its inside";
}

}  // namespace
}  // namespace restlab::unit
