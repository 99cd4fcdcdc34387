// Rays and fields: no crossing is passed over, bounds hold what is computed, closed surfaces are
// tight, and a hit is not met again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/field/expression.h"
#include "core/scene/field/solid.h"
#include "tests/unit/grid_cases.h"
#include "tests/unit/shape_cases.h"

namespace restlab::unit {
namespace {

struct FieldCase {
  std::string name;
  FieldProgram field;
};

FieldProgram ofExpression(const std::string& text, float reach = 1.0f) {
  return readExpression(text, glm::vec3(-reach), glm::vec3(reach));
}

// Samples that say inside and outside alone, far steeper than distances.
SampledGrid signGrid() {
  return sampledGrid(glm::ivec3(20, 20, 20), glm::dvec3(-1.0), glm::dvec3(1.0),
                     [](const glm::dvec3& p) { return glm::length(p) < 0.75 ? -5.0 : 8.0; });
}

// Cells of three widths, with a wall that is thinner than they are.
SampledGrid longGrid() {
  return sampledGrid(glm::ivec3(40, 7, 11), glm::dvec3(-0.4, -0.5, -1.2), glm::dvec3(0.5, 0.6, 1.1),
                     [](const glm::dvec3& p) {
                       const glm::dvec3 d = glm::abs(p) - glm::dvec3(0.015, 0.35, 0.8);
                       return std::max({d.x, d.y, d.z});
                     });
}

const std::vector<FieldCase>& fieldCases() {
  static const std::vector<FieldCase> kAll{
      {"sphere", ofExpression("x^2 + y^2 + z^2 - 1", 1.1f)},
      {"torus", ofExpression("(sqrt(x^2 + y^2) - 0.7)^2 + z^2 - 0.0625")},
      {"thin_torus", ofExpression("(sqrt(x^2 + y^2) - 0.7)^2 + z^2 - 1e-5")},
      {"gyroid", ofExpression("sin(6*x)*cos(6*y) + sin(6*y)*cos(6*z) + sin(6*z)*cos(6*x)")},
      {"tangle", ofExpression("x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8", 3.0f)},
      {"heart", ofExpression("(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3", 1.5f)},
      {"cone", ofExpression("x^2 + y^2 - z^2")},
      {"plates", ofExpression("(z - 0.1)*(z - 0.1004)")},
      {"exponential", ofExpression("z - exp(-8*(x^2 + y^2)) + 0.5/(1 + x^2)")},
      {"dumbbell",
       readSolid("smooth_union(0.3, translate(-0.5, 0, 0, sphere(0.45)), translate(0.5, "
                 "0.1, 0, rotate(0, 0, 1, 30, box(0.4, 0.3, 0.35))))")},
      {"twisted", readSolid("twist(60, box(0.3, 0.3, 1))")},
      {"displaced", readSolid("displace(0.05, 15, sphere(1))")},
      {"shell", readSolid("difference(shell(0.01, sphere(1)), translate(1, 0, 0, sphere(0.7)))")},
      {"plate", readSolid("box(1, 1, 0.0002)")},
      {"copies", readSolid("repeat(0.5, 0.5, 0, sphere(0.2))",
                           std::array{glm::vec3(-1.0f), glm::vec3(1.0f)})},
      {"grid", solidOfGrids("grid('a')", {{"a", sphereGrid(24, 1.0, 0.8)}})},
      {"grid_of_noise", solidOfGrids("grid('a')", {{"a", noiseGrid(12, 7)}})},
      {"grid_of_signs", solidOfGrids("grid('a')", {{"a", signGrid()}})},
      {"grids_in_tree",
       solidOfGrids("smooth_union(0.2, rotate(1, 2, 3, 40, grid('a')), translate(0.7, 0, 0, "
                    "scale(0.3, grid('b'))), translate(0, 0.6, 0.5, sphere(0.4)))",
                    {{"a", sphereGrid(9, 0.7, 0.6)}, {"b", noiseGrid(6, 8)}})},
      {"grid_twisted", solidOfGrids("twist(50, grid('a'))", {{"a", longGrid()}})},
      {"grid_cut", solidOfGrids("grid('a')", {{"a", sphereGrid(17, 0.7, 0.8)}},
                                std::array{glm::vec3(-0.9f), glm::vec3(0.9f)})}};
  return kAll;
}

struct LocalField {
  explicit LocalField(const FieldProgram& of) {
    ShapeGeometry geometry;
    geometry.words = fieldWords(of);
    words = shapeWords(geometry);
    shape.kind = rl::RL_SHAPE_IMPLICIT;
    d.scene.shapeWords.data = words.data();
    field = d->fieldOf(shape);
  }
  std::vector<glm::uvec4> words;
  rl::Shape shape{};
  Dialect<> d;
  rl::Field field{};
};

class Fields : public testing::TestWithParam<FieldCase> {};

rl::Ray rayThrough(const FieldProgram& field, Inputs& inputs) {
  const glm::vec3 u(inputs.square(), inputs.uniform());
  const glm::vec3 dir = inputs.direction();
  const float away = inputs.below(4) == 0 ? 0.0f : inputs.scale(0.1f, 100.0f);
  return rayOf(glm::mix(field.low, field.high, u) - dir * away, dir);
}

// Where the sign first changes, by small steps in double precision; negative: nowhere.
double firstCrossing(const FieldProgram& field, const rl::Ray& ray) {
  const glm::dvec3 o(ray.origin), d(ray.dir);
  double from = 0.0, to = 1e9;
  for (int c = 0; c < 3; ++c) {
    const double a = (double(field.low[c]) - o[c]) / d[c],
                 b = (double(field.high[c]) - o[c]) / d[c];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (from >= to) return -1.0;
  constexpr int kSteps = 2000;
  const double step = (to - from) / kSteps;
  const bool isInside = field.at(o + d * from) < 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    if ((field.at(o + d * (from + i * step)) < 0.0) == isInside) continue;
    double low = from + (i - 1) * step, high = from + i * step;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      ((field.at(o + d * middle) < 0.0) == isInside ? low : high) = middle;
    }
    return low;
  }
  return -1.0;
}

TEST_P(Fields, NoCrossingIsPassedOver) {
  const FieldProgram& field = GetParam().field;
  LocalField local(field);
  Inputs inputs(1);
  int crossed = 0, missed = 0, late = 0;
  for (int i = 0; i < 4000; ++i) {
    const rl::Ray ray = rayThrough(field, inputs);
    const double first = firstCrossing(field, ray);
    if (first < 0.0) continue;
    ++crossed;
    rl::Hit hit{};
    if (!local.d->shapeIntersect(local.shape, ray, hit)) {
      ++missed;
      continue;
    }
    const double error = 4e-6 * (1.0 + double(glm::length(ray.origin)));
    if (double(hit.t) > first + error) ++late;
  }
  EXPECT_GT(crossed, 1);
  EXPECT_EQ(missed, 0) << "of " << crossed;
  EXPECT_LE(late, 1) << "of " << crossed;  // one may graze
  EXPECT_EQ(local.d.counters.health[rl::RL_HEALTH_SEGMENTS], 0u);
}

// All of the tracing rests on this.
TEST_P(Fields, BoundsHoldWhatIsComputed) {
  const FieldProgram& field = GetParam().field;
  LocalField local(field);
  Inputs inputs(2);
  for (int i = 0; i < 3000; ++i) {
    const auto any = [&] {
      const glm::vec3 u(inputs.square(), inputs.uniform());
      return glm::mix(field.low, field.high, u);
    };
    const glm::vec3 from = any(), dir = any() - from;
    const glm::vec3 to = from + dir * inputs.scale(1e-6f, 1.0f);
    const glm::vec4 range = local.d->fieldRange(local.field, from, to, dir);
    const double slack = 1e-5 * (1.0 + std::abs(double(range.z)) + std::abs(double(range.w)));
    for (int k = 0; k <= 8; ++k) {
      const glm::vec3 at = from + (to - from) * (0.125f * float(k));
      const glm::vec2 value = local.d->fieldSlope(local.field, at, dir);
      ASSERT_GE(value.x, range.x) << "place " << i;
      ASSERT_LE(value.x, range.y) << "place " << i;
      ASSERT_GE(double(value.y), double(range.z) - slack) << "place " << i;
      ASSERT_LE(double(value.y), double(range.w) + slack) << "place " << i;
      ASSERT_NEAR(value.x, field.at(glm::dvec3(at)), 1e-4 * (1.0 + std::abs(double(value.x))))
          << "place " << i;
    }
  }
}

// A ray that goes on behind a hit meets other crossings alone: a veil counts each once.
TEST_P(Fields, AHitIsNotMetAgain) {
  const FieldProgram& field = GetParam().field;
  LocalField local(field);
  Inputs inputs(3);
  int continued = 0, again = 0;
  for (int i = 0; i < 4000; ++i) {
    rl::Ray ray = rayThrough(field, inputs);
    bool wasInside = false;
    rl::Hit hit{};
    for (int k = 0; k < 40 && local.d->shapeIntersect(local.shape, ray, hit); ++k) {
      ASSERT_GT(hit.t, ray.tMin);
      const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
      const float cosine = glm::dot(p.normalL, ray.dir);
      const bool enters = cosine < 0.0f;
      if (k > 0 && std::abs(cosine) > 0.05f) {
        ++continued;
        if (enters == wasInside) ++again;
      }
      wasInside = enters;
      if (std::abs(cosine) <= 0.05f) break;
      ray.tMin = hit.t;
    }
  }
  EXPECT_GT(continued, 0);
  EXPECT_LE(again, 1 + continued / 1000) << "of " << continued;  // at an edge
}

// Rays go from surface to surface, 10^6 of them in all of the closed ones.
TEST_P(Fields, ClosedOnesAreTight) {
  const FieldProgram& field = GetParam().field;
  if (!field.isClosed) GTEST_SKIP() << "an open surface";
  LocalField local(field);
  Inputs inputs(4);
  glm::vec3 start(0.0f);
  for (int i = 0; i < 1'000'000 && !(field.at(glm::dvec3(start)) < -1e-6); ++i) {
    const glm::vec3 u(inputs.square(), inputs.uniform());
    start = glm::mix(field.low, field.high, u);
  }
  int escaped = 0, rays = 0;
  for (int path = 0; path < 10'000; ++path) {
    glm::vec3 at = start, dir = inputs.direction();
    for (int bounce = 0; bounce < 10; ++bounce, ++rays) {
      rl::Hit hit{};
      if (!local.d->shapeIntersect(local.shape, rayOf(at, dir), hit)) {
        ++escaped;
        break;
      }
      const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
      dir = inputs.directionAbove(-p.normalL);
      at = p.posL - p.normalL * (rl::RL_HIT_ERROR * p.extent.x);
    }
  }
  EXPECT_GT(rays, 50'000);
  // At a sharp rim the bound of errors moves a point out through the other side.
  EXPECT_LE(escaped, rays / 20'000) << "of " << rays;
}

INSTANTIATE_TEST_SUITE_P(, Fields, testing::ValuesIn(fieldCases()),
                         [](const auto& one) { return one.param.name; });

// The unit sphere as an equation, as an expression and as a solid.
TEST(FieldSpheres, AgreeWithTheSphere) {
  LocalShape sphere(shapeNamed("sphere"));
  for (const char* name : {"implicit_sphere", "sdf_sphere"}) {
    LocalShape local(shapeNamed(name));
    Inputs inputs(5);
    int hits = 0, differ = 0;
    double worst = 0.0, worstNormal = 0.0;
    for (int i = 0; i < 100'000; ++i) {
      const glm::vec3 dir = inputs.direction();
      const rl::Ray ray = rayOf(1.5f * inputs.direction() - dir * inputs.scale(0.1f, 100.0f), dir);
      rl::Hit expected{}, hit{};
      const bool isHit = sphere.d->shapeIntersect(sphere.shape, ray, expected);
      if (isHit != local.d->shapeIntersect(local.shape, ray, hit)) {
        ++differ;  // it grazes
        continue;
      }
      if (!isHit) continue;
      ++hits;
      const rl::ShapePoint a = sphere.d->shapePoint(sphere.shape, idOf(expected)),
                           b = local.d->shapePoint(local.shape, idOf(hit));
      const double cosine = std::abs(double(glm::dot(a.normalL, dir)));
      if (cosine < 0.02) continue;
      worst = std::max(worst, double(glm::distance(a.posL, b.posL)) * cosine /
                                  (1.0 + double(glm::length(ray.origin))));
      worstNormal = std::max(worstNormal, double(glm::distance(b.posL, b.normalL)));
    }
    EXPECT_GT(hits, 20'000) << name;
    EXPECT_LE(differ, 5) << name;
    EXPECT_LT(worst, 1e-6) << name;
    EXPECT_LT(worstNormal, 1e-6) << name;
  }
}

// Two crossings that are close are both found, down to the shortest segment.
TEST(FieldTrace, ThinPlatesAreMetFromBothSides) {
  for (const float thickness : {1e-2f, 1e-3f, 1e-4f, 1e-5f}) {
    LocalField local(readSolid(fmt::format("box(1, 1, {:.7f})", 0.5f * thickness)));
    Inputs inputs(6);
    for (int i = 0; i < 2000; ++i) {
      const glm::vec3 target(inputs.uniform(-0.9f, 0.9f), inputs.uniform(-0.9f, 0.9f), 0.0f);
      glm::vec3 dir = inputs.direction();
      dir.z = dir.z < 0.0f ? dir.z - 0.1f : dir.z + 0.1f;
      dir = glm::normalize(dir);
      rl::Hit hit{};
      rl::Ray ray = rayOf(target - 2.0f * dir, dir);
      ASSERT_TRUE(local.d->shapeIntersect(local.shape, ray, hit)) << thickness << ", ray " << i;
    }
  }
}

}  // namespace
}  // namespace restlab::unit
