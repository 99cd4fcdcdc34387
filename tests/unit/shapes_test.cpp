// Every kind of shape beside triangles: rays and points agree; closed shapes do not leak, and no
// shape shadows itself, whatever its size and place.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>

#include "core/scene/shapes/fine_meshes.h"
#include "tests/unit/shape_cases.h"

namespace restlab::unit {
namespace {

// Inside of a closed shape, from its definition, for the kinds that are defined here.
std::optional<bool> definedInside(const std::string& name, const glm::dvec3& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  if (name == "sphere") return glm::length(p) < 1.0;
  if (name == "cube") return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1.0;
  if (name == "cylinder") return r2 < 1.0 && p.z > 0.0 && p.z < 1.0;
  if (name == "cone") return p.z > 0.0 && p.z < 1.0 && std::sqrt(r2) < 1.0 - p.z;
  return {};
}

// How close a point is to its ray, relative to the distances of both. Kinds without draws may find
// their points step by step.
float accuracyOf(const ShapeCase& of) { return of.info->hasDraws ? 2e-6f : 2e-5f; }

class Shapes : public testing::TestWithParam<ShapeCase> {};

TEST_P(Shapes, ThePointOfAnIdLiesOnTheRay) {
  LocalShape local(GetParam());
  Inputs inputs(1);
  const float size = GetParam().size(), accuracy = accuracyOf(GetParam());
  int hits = 0;
  for (int i = 0; i < 100'000; ++i) {
    const glm::vec3 target = GetParam().inBox(inputs);
    const glm::vec3 dir = inputs.direction();
    const float away = inputs.below(4) == 0 ? 0.0f : size * inputs.scale(0.05f, 5e2f);
    rl::Hit hit{};
    const rl::Ray ray = rayOf(target - dir * away, dir * inputs.scale(1e-3f, 1e3f));
    if (!local.d->shapeIntersect(local.shape, ray, hit)) continue;
    ++hits;
    ASSERT_GT(hit.t, 0.0f);
    ASSERT_TRUE(hit.bary.x >= 0.0f && hit.bary.x <= 1.0f && hit.bary.y >= 0.0f &&
                hit.bary.y <= 1.0f);
    // Reservoirs of direct light have three bits for it.
    ASSERT_TRUE(hit.primitive < 8u || !GetParam().info->hasDraws);
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    const float reach = std::max({1.0f, glm::length(ray.origin), glm::length(p.posL)});
    // A ray that grazes has a point that moves far for a small error.
    const float cosine = std::abs(glm::dot(p.normalL, dir));
    ASSERT_LT(glm::distance(ray.origin + hit.t * ray.dir, p.posL),
              accuracy * reach / std::max(cosine, 1e-3f))
        << "ray " << i;
    // As reservoirs hold it.
    hit.bary = {local.d->unpackUnorm24(local.d->packUnorm24(hit.bary.x)),
                local.d->unpackUnorm24(local.d->packUnorm24(hit.bary.y))};
    const rl::ShapePoint kept = local.d->shapePoint(local.shape, idOf(hit));
    const float extent = std::max({1.0f, p.extent.x, p.extent.y, p.extent.z});
    ASSERT_LT(glm::distance(kept.posL, p.posL), accuracy * extent);
    ASSERT_NEAR(glm::length(p.normalL), 1.0f, 1e-6f);
    for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(p.posL[c]), p.extent[c] + 1e-6f);
    ASSERT_LT(std::abs(glm::dot(p.normalL, glm::normalize(p.dpdu))), 1e-5f);
    ASSERT_LT(std::abs(glm::dot(p.normalL, glm::normalize(p.dpdv))), 1e-5f);
  }
  EXPECT_GT(hits, 1000);
}

TEST_P(Shapes, TheFirstPointIsFound) {
  if (!GetParam().isClosed) GTEST_SKIP() << "an open shape";
  LocalShape local(GetParam());
  Inputs inputs(2);
  const double size = GetParam().size(), step = 0.001 * size;
  const double accuracy = (GetParam().info->hasDraws ? 5e-5 : 5e-4) * size;
  int crossed = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 4000; ++i) {
    // Kinds may take long to tell what is inside.
    if (crossed > 300 && std::chrono::steady_clock::now() - begin > std::chrono::seconds(20)) break;
    const glm::vec3 target = GetParam().inBox(inputs), from = GetParam().inBox(inputs);
    const glm::vec3 origin = i % 2 == 0 ? from : 3.0f * from;
    const glm::vec3 dir = glm::normalize(target - origin);
    const auto inside = [&](double t) {
      const glm::dvec3 at = glm::dvec3(origin) + t * glm::dvec3(dir);
      const bool is = GetParam().info->isInside(GetParam().shape, at);
      const std::optional<bool> defined = definedInside(GetParam().info->name, at);
      EXPECT_TRUE(!defined || *defined == is);
      return is;
    };
    const bool isWithin = inside(0.0);
    double low = 0.0, high = -1.0;
    for (double t = step; t < 4.0 * size; t += step) {
      if (inside(t) != isWithin) {
        low = t - step;
        high = t;
        break;
      }
    }
    rl::Hit hit{};
    const bool found = local.d->shapeIntersect(local.shape, rayOf(origin, dir), hit);
    if (high < 0.0) continue;  // thin corners fall between the steps
    ++crossed;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (inside(middle) == isWithin ? low : high) = middle;
    }
    ASSERT_TRUE(found) << "ray " << i;
    if (double(hit.t) < low - step) continue;  // an earlier corner that the steps passed over
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    const float cosine = glm::dot(p.normalL, dir);
    ASSERT_NEAR(hit.t, high, accuracy / std::clamp(10.0 * std::abs(double(cosine)), 0.01, 1.0))
        << "ray " << i;
    ASSERT_TRUE((cosine > 0.0f) == isWithin || std::abs(cosine) < 1e-3f)
        << "the normal points outside";
  }
  EXPECT_GT(crossed, 300);
}

TEST_P(Shapes, TheStandInFacesOutside) {
  LocalShape local(GetParam());
  const MeshGeometry mesh = GetParam().info->standIn(GetParam().shape);
  const float away = 0.05f * GetParam().size();
  int compared = 0, wrong = 0;
  double area = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::vec3 n = glm::cross(b - a, c - a);
    area += 0.5 * double(glm::length(n));
    if (!(glm::length(n) > 1e-6f)) continue;
    const glm::vec3 unit = glm::normalize(n), centre = (a + b + c) / 3.0f;
    // Beyond a narrow gap lies another part of the surface.
    bool isRight = false;
    for (const float distance : {away, 0.1f * away}) {
      rl::Hit hit{};
      rl::Ray ray = rayOf(centre + distance * unit, -unit);
      ray.tMax = 2.0f * distance;
      if (!local.d->shapeIntersect(local.shape, ray, hit)) continue;
      const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
      isRight = isRight || glm::dot(p.normalL, unit) > 0.5f;
    }
    ++compared;
    if (!isRight) ++wrong;
  }
  EXPECT_GT(compared, 1);
  if (!GetParam().info->hasDraws) {
    EXPECT_LE(wrong, compared / 20);
    return;
  }
  EXPECT_EQ(wrong, 0) << "of " << compared;
  double own = 0.0;
  forEachCell(local, 256,
              [&](uint32_t, int, int, const rl::ShapePoint&, double cell) { own += cell; });
  EXPECT_NEAR(area / own, 1.0, 0.02);
}

TEST_P(Shapes, TheFineMeshHasItsNormalsAndTextureCoordinates) {
  LocalShape local(GetParam());
  const MeshGeometry mesh = fineMesh(GetParam().shape);
  if (mesh.normals.empty()) GTEST_SKIP() << "a kind that core/scene/shapes/fine_meshes.cpp lacks";
  int compared = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto mean = [&](const auto& of) { return (of[t.x] + of[t.y] + of[t.z]) / 3.0f; };
    const glm::vec3 n = glm::normalize(mean(mesh.normals)), at = mean(mesh.positions);
    rl::Hit hit{};
    rl::Ray ray = rayOf(at + 0.1f * n, -n);
    ray.tMax = 0.2f;
    ASSERT_TRUE(local.d->shapeIntersect(local.shape, ray, hit));
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    ASSERT_LT(glm::distance(p.normalL, n), 0.03f);
    const glm::vec2 uv = mean(mesh.uvs[0]);
    EXPECT_NEAR(p.uv.x, uv.x, 0.01f + 1e-6f * std::abs(uv.x));
    EXPECT_NEAR(p.uv.y, uv.y, 0.01f + 1e-6f * std::abs(uv.y));
    ++compared;
  }
  EXPECT_GT(compared, 1);
}

// Rays leave to the outside, many of them flat. One that meets the shape again, which only shapes
// that are not convex allow, must enter it: it has left already.
TEST_P(Shapes, NoneHitsItselfAtAnySize) {
  if (!GetParam().info->isConvex && !GetParam().isClosed)
    GTEST_SKIP() << "a ray may meet either side again";
  uint64_t left = 0, selfHits = 0, missed = 0, aimed = 0;
  Inputs inputs(4);
  const glm::dvec3 inside(GetParam().anyInside());
  for (int exponent = -13; exponent <= 17; exponent += 3) {
    for (const double distance : {0.0, 1.0, 100.0}) {
      const double size = std::exp2(exponent);
      glm::dmat4 m =
          glm::translate(glm::dmat4(1.0), distance * size * glm::dvec3(0.48, -0.6, 0.64));
      m = glm::rotate(m, 6.28 * inputs.uniform(), glm::dvec3(inputs.direction()));
      m = glm::scale(m, size * glm::dvec3(1.0, inputs.scale(0.3f, 1.0f), -0.7));
      const auto scene = placedShape(GetParam(), m);
      Dialect<> d(scene);
      for (int i = 0; i < 1500; ++i) {
        const glm::vec3 centre(glm::dvec3(m * glm::dvec4(inside, 1.0)) - scene->origin());
        const glm::vec3 dir = inputs.direction();
        rl::Hit hit{};
        d->traceRay(rayOf(centre - dir * float(size) * inputs.scale(2.0f, 50.0f), dir),
                    rl::RL_RAY_PATH, 0, hit);
        ++aimed;
        if (hit.instance == rl::RL_INVALID) {
          ++missed;
          continue;
        }
        const rl::Surface s = d->surfaceLoad(hit, dir);
        if (s.isFront == 0u) continue;
        const glm::vec3 flat = inputs.direction();
        const float lift = inputs.below(2) == 0 ? 1.0f : inputs.scale(1e-6f, 1.0f);
        const glm::vec3 above =
            flat - s.nGeoW * (glm::dot(s.nGeoW, flat) - lift * std::abs(glm::dot(s.nGeoW, flat)));
        const glm::vec3 out = glm::normalize(above);
        if (glm::dot(s.nGeoW, out) < 0.0f) continue;  // by rounding
        rl::Hit next{};
        d->traceRay(rayOf(d->surfaceOffset(s.posW, s.nGeoW, s.posError, out), out), rl::RL_RAY_PATH,
                    0, next);
        ++left;
        if (next.instance == rl::RL_INVALID) continue;
        const rl::Surface there = d->surfaceLoad(next, out);
        const bool enters =
            there.isFront != 0u || std::abs(glm::dot(there.nGeoW, out)) < 1e-3f;  // or touches
        if (GetParam().info->isConvex || !enters) ++selfHits;
      }
    }
  }
  EXPECT_GT(left, 10'000u);
  EXPECT_EQ(selfHits, 0u) << "of " << left;
  EXPECT_TRUE(!GetParam().isClosed || missed == 0u) << missed << " of " << aimed;
}

// Rays from inside to where parts meet: their coordinates end there.
TEST_P(Shapes, NoRaySlipsThroughAnEdge) {
  if (!GetParam().isClosed || !GetParam().info->hasDraws)
    GTEST_SKIP() << "an open shape, or one whose parts are not known";
  LocalShape local(GetParam());
  Inputs inputs(9);
  const glm::vec3 inside = GetParam().anyInside();
  int slipped = 0;
  for (int i = 0; i < 100'000; ++i) {
    const float end = inputs.below(2) == 0 ? 0.0f : 1.0f, along = inputs.uniform();
    const glm::vec2 bary = inputs.below(2) == 0 ? glm::vec2(along, end) : glm::vec2(end, along);
    const rl::ShapePoint edge = local.d->shapePoint(local.shape, {0, inputs.below(6), bary});
    glm::vec3 from = inside + 0.02f * GetParam().size() * inputs.direction();
    if (!GetParam().info->isInside(GetParam().shape, glm::dvec3(from))) from = inside;
    rl::Hit hit{};
    if (!local.d->shapeIntersect(local.shape, rayOf(from, edge.posL - from), hit)) ++slipped;
  }
  EXPECT_EQ(slipped, 0);
}

// As rays that pass surfaces do: they go on from the hit itself.
TEST_P(Shapes, RaysThatGoOnMeetEachCrossingOnce) {
  if (!GetParam().isClosed) GTEST_SKIP() << "an open shape";
  LocalShape local(GetParam());
  Inputs inputs(11);
  int odd = 0, sameSide = 0, rays = 0;
  for (int i = 0; i < 5000; ++i) {
    const glm::vec3 dir = inputs.direction();
    rl::Ray ray = rayOf(GetParam().inBox(inputs) - dir * (4.0f * GetParam().size()), dir);
    int crossings = 0;
    bool isGrazing = false, wasFront = false;
    rl::Hit hit{};
    for (; crossings < 64 && local.d->shapeIntersect(local.shape, ray, hit); ++crossings) {
      const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
      const float cosine = glm::dot(p.normalL, dir);
      isGrazing = isGrazing || std::abs(cosine) < 0.05f;
      const bool isFront = cosine < 0.0f;
      if (crossings > 0 && isFront == wasFront && !isGrazing) ++sameSide;
      wasFront = isFront;
      ray.tMin = hit.t;
    }
    if (isGrazing) continue;
    ++rays;
    odd += crossings % 2;
  }
  EXPECT_GT(rays, 3000);
  EXPECT_EQ(odd, 0) << "of " << rays;
  EXPECT_EQ(sameSide, 0) << "of " << rays;
}

TEST_P(Shapes, ClosedOnesDoNotLeak) {
  if (!GetParam().isClosed) GTEST_SKIP() << "an open shape";
  Inputs inputs(5);
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -2.0, 1.0));
  m = glm::scale(glm::rotate(m, 0.7, glm::dvec3(0.3, 0.9, -0.2)), glm::dvec3(1.5, 0.7, 1.1));
  const auto scene = placedShape(GetParam(), m);
  const glm::dvec4 inside(glm::dvec3(GetParam().anyInside()), 1.0);
  Dialect<> d(scene);
  uint64_t escaped = 0, rays = 0;
  for (int path = 0; path < 20'000; ++path) {
    glm::vec3 at(glm::dvec3(m * inside) - scene->origin());
    glm::vec3 dir = inputs.direction();
    for (int bounce = 0; bounce < 10; ++bounce) {
      rl::Hit hit{};
      d->traceRay(rayOf(at, dir), rl::RL_RAY_PATH, 0, hit);
      ++rays;
      if (hit.instance == rl::RL_INVALID) {
        ++escaped;
        break;
      }
      const rl::Surface s = d->surfaceLoad(hit, dir);
      dir = inputs.directionAbove(s.nGeoW);
      at = d->surfaceOffset(s.posW, s.nGeoW, s.posError, dir);
    }
  }
  EXPECT_GT(rays, 150'000u);
  // At a sharp rim the bound of errors moves a point out through the other side.
  EXPECT_LE(escaped, rays / 100'000) << "of " << rays;
}

INSTANTIATE_TEST_SUITE_P(, Shapes, testing::ValuesIn(shapeCases()),
                         [](const auto& one) { return one.param.name; });

// Distance of a torus along a ray where it is least, between two places.
double leastDistance(const std::function<double(double)>& distance, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (distance(a) < distance(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return 0.5 * (low + high);
}

// Rays that touch the torus, but for a little to either side: two roots that are close are found,
// and none is where there is none. A ray may meet other parts before.
TEST(ShapeTorus, RaysThatGrazeAreRight) {
  int touched = 0, passed = 0;
  for (const char* name : {"torus", "torus_thin", "torus_fat"}) {
    const ShapeCase& of = shapeNamed(name);
    const double r = double(of.shape.values[0]);
    LocalShape local(of);
    Inputs inputs(11);
    for (int i = 0; i < 4000; ++i) {
      const rl::ShapePoint p = local.d->shapePoint(local.shape, {0, 0, inputs.square()});
      const float side = inputs.below(2) == 0 ? 1.0f : -1.0f;
      const glm::vec3 target = p.posL + side * inputs.scale(3e-6f, 1e-3f) * p.normalL;
      const glm::vec3 dir = glm::normalize(glm::cross(p.normalL, inputs.direction()));
      const rl::Ray ray = rayOf(target - 4.0f * dir, dir);
      const auto distance = [&](double t) {
        const glm::dvec3 at = glm::dvec3(ray.origin) + t * glm::dvec3(ray.dir);
        return std::hypot(std::hypot(at.x, at.y) - 1.0, at.z) - r;
      };
      constexpr double kStep = 2e-3;
      double first = -1.0, least = 1.0;
      for (double t = kStep; t < 8.0 && first < 0.0; t += kStep) {
        if (distance(t) > distance(t - kStep) || distance(t) > distance(t + kStep)) continue;
        const double turn = leastDistance(distance, t - kStep, t + kStep);
        least = std::min(least, distance(turn));
        if (distance(turn) < -2e-6) first = turn;
      }
      rl::Hit hit{};
      const bool isHit = local.d->shapeIntersect(local.shape, ray, hit);
      if (first > 0.0) {
        ++touched;
        ASSERT_TRUE(isHit) << name << " " << i << ": dips by " << -least;
        ASSERT_LT(double(hit.t), first) << name << " " << i << ": a root was passed over";
      } else if (least > 2e-6) {
        ++passed;
        ASSERT_FALSE(isHit) << name << " " << i << ": passes by " << least;
      }
    }
  }
  EXPECT_GT(touched, 3000);
  EXPECT_GT(passed, 1500);
}

// A ray that passes the front of a half transparent ball may still be stopped by its back.
TEST(ShapeAlpha, BothSidesDecide) {
  builtin::SceneBuilder builder("veil");
  rl::Material veil = builtin::lambert(glm::vec3(0.5f));
  veil.alpha = 0.5f;
  veil.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  const uint32_t id = builder.addMaterial("veil", veil);
  builder.place("ball", builder.addGeometry(makeShape(shapeNamed("sphere").shape, "ball")), id,
                glm::dmat4(1.0));
  Dialect<> d(CompiledScene::build(builder.finish()));
  Inputs inputs(7);
  int passed = 0, first = 0;
  constexpr int kRays = 20'000;
  for (int i = 0; i < kRays; ++i) {
    const glm::vec3 dir = inputs.direction();
    const rl::Ray ray = rayOf(-4.0f * dir + 0.3f * inputs.direction(), dir);
    rl::Hit hit{};
    d->traceRay(ray, rl::RL_RAY_PATH, inputs.bits(), hit);
    passed += hit.instance == rl::RL_INVALID ? 1 : 0;
    first += hit.instance != rl::RL_INVALID && hit.t < 4.0f ? 1 : 0;
    rl::Hit unused{};
    rl::Ray shadow = ray;
    shadow.tMax = 10.0f;
    ASSERT_FLOAT_EQ(d->traceRay(shadow, rl::RL_RAY_SHADOW, 0, unused), 0.25f);
  }
  EXPECT_NEAR(double(first) / kRays, 0.5, 0.02);
  EXPECT_NEAR(double(passed) / kRays, 0.25, 0.02);
}

// A camera between a ball and the triangles that stand in for it is in the ball.
TEST(ShapeBodies, ReachToTheSurface) {
  builtin::SceneBuilder builder("ball");
  const uint32_t id = builder.addMaterial("glass", builtin::glass(0.0f, glm::vec3(1.0f)));
  builder.place("ball", builder.addGeometry(makeShape(shapeNamed("sphere").shape, "ball")), id,
                glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
  const auto scene = CompiledScene::build(builder.finish());
  Inputs inputs(8);
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 n = inputs.direction();
    EXPECT_NE(scene->bodiesAt(1.9999f * n - glm::vec3(scene->origin())).x, 0u);
    EXPECT_EQ(scene->bodiesAt(2.0001f * n - glm::vec3(scene->origin())).x, 0u);
  }
}

}  // namespace
}  // namespace restlab::unit
