// Form factors of radiosity against known ones (Howell, "A Catalog of Radiation Heat Transfer
// Configuration Factors", C-11, C-14, C-41): those of areas are means of those of points.
#include <gtest/gtest.h>

#include <cmath>

#include "core/dialect/math.h"
#include "core/geometry/surface.h"
#include "tests/unit/constants.h"

namespace rl::form_factor {

struct Ctx {
#include "integrators/radiosity/form_factor.glsl"
};

}  // namespace rl::form_factor

namespace restlab::unit {
namespace {

using Point = glm::vec3;

struct Triangle {
  Point a, b, c;
};

double factor(const Point& from, const Point& normal, const std::vector<Triangle>& seen) {
  rl::form_factor::Ctx ctx;
  double sum = 0.0;
  for (const Triangle& t : seen)
    sum += double(ctx.formFactorOfTriangle(normal, t.a - from, t.b - from, t.c - from));
  return sum;
}

std::vector<Triangle> square(const Point& corner, const Point& u, const Point& v) {
  return {{corner, corner + u, corner + v}, {corner + u + v, corner + v, corner + u}};
}

// Mean over the unit square z = 0, which looks up.
double meanOverSquare(const std::vector<Triangle>& seen) {
  constexpr int kSteps = 100;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      sum +=
          factor({(float(i) + 0.5f) / kSteps, (float(j) + 0.5f) / kSteps, 0.0f}, {0, 0, 1}, seen);
  return sum / (kSteps * kSteps);
}

TEST(FormFactor, ParallelSquares) {
  EXPECT_NEAR(meanOverSquare(square({0, 0, 1}, {1, 0, 0}, {0, 1, 0})), 0.199825, 1e-4);
}

// Half of what points of the square see of the wall's plane lies below their horizon if the wall
// reaches below: the clipped part must not count.
TEST(FormFactor, PerpendicularSquaresClippedAtTheHorizon) {
  EXPECT_NEAR(meanOverSquare(square({0, 0, 0}, {1, 0, 0}, {0, 0, 1})), 0.200044, 2e-4);
  EXPECT_NEAR(meanOverSquare(square({0, 0, -1}, {1, 0, 0}, {0, 0, 2})), 0.200044, 2e-4);
  EXPECT_EQ(meanOverSquare(square({0, 0, -2}, {1, 0, 0}, {0, 0, 1})), 0.0);
}

TEST(FormFactor, DiskToDisk) {
  std::vector<Triangle> disk;
  constexpr int kSides = 512;
  const auto rim = [](int i) {
    const double angle = 2.0 * kPi * i / kSides;
    return Point(float(std::cos(angle)), float(std::sin(angle)), 1.0f);
  };
  for (int i = 0; i < kSides; ++i) disk.push_back({{0, 0, 1}, rim(i), rim(i + 1)});
  // By rings of equal area.
  constexpr int kRings = 64;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i)
    sum += factor({std::sqrt((float(i) + 0.5f) / kRings), 0.0f, 0.0f}, {0, 0, 1}, disk);
  EXPECT_NEAR(sum / kRings, 0.5 * (3.0 - std::sqrt(5.0)), 1e-3);
}

// Whatever surrounds a point sends all of its light.
TEST(FormFactor, ABoxAroundAPointAddsUpToOne) {
  std::vector<Triangle> box;
  const auto add = [&](const std::vector<Triangle>& more) {
    box.insert(box.end(), more.begin(), more.end());
  };
  add(square({-1, -1, 2}, {3, 0, 0}, {0, 3, 0}));
  add(square({-1, -1, -2}, {3, 0, 0}, {0, 3, 0}));
  add(square({-1, -1, -2}, {3, 0, 0}, {0, 0, 4}));
  add(square({-1, 2, -2}, {3, 0, 0}, {0, 0, 4}));
  add(square({-1, -1, -2}, {0, 3, 0}, {0, 0, 4}));
  add(square({2, -1, -2}, {0, 3, 0}, {0, 0, 4}));
  for (const Point& normal : {Point(0, 0, 1), Point(0, 1, 0), Point(1, 0, 0),
                              Point(0.6f, 0.0f, 0.8f), Point(0.36f, 0.48f, 0.8f)})
    EXPECT_NEAR(factor({0.1f, 0.2f, 0.3f}, normal, box), 1.0, 1e-5);
}

}  // namespace
}  // namespace restlab::unit
