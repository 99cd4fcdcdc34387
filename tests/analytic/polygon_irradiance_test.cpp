// Lambert's formula against closed forms of the heat-transfer literature (Howell's catalogue C-11
// and C-12), against quadrature, and at its limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "experiments/truths/polygon_irradiance.h"

namespace restlab::analytic {
namespace {

const glm::dvec3 kOrigin(0.0), kUp(0.0, 0.0, 1.0);

// A rectangle with a corner over the point, parallel to it: sides a, b at height c (C-11).
double cornerParallel(double a, double b, double c) {
  const double x = a / c, y = b / c;
  const double p = std::sqrt(1.0 + x * x), q = std::sqrt(1.0 + y * y);
  return 0.5 * (x / p * std::atan(y / p) + y / q * std::atan(x / q));
}

// A rectangle standing on the horizon, its lower edge of length b starting over the point at
// distance c, height a: the point's normal is parallel to it (C-12).
double cornerUpright(double a, double b, double c) {
  const double x = a / b, y = c / b;
  const double r = std::sqrt(x * x + y * y);
  return 0.5 * (std::atan(1.0 / y) - y / r * std::atan(1.0 / r));
}

// Corners counter-clockwise as seen from below.
std::vector<glm::dvec3> parallelQuad(double a, double b, double c) {
  return {{0, 0, c}, {0, b, c}, {a, b, c}, {a, 0, c}};
}

// Midpoint quadrature over a parallelogram, n x n.
double quadrature(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int n) {
  const glm::dvec3 area = glm::cross(u, v);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 p = corner + u * ((i + 0.5) / n) + v * ((j + 0.5) / n);
      const double d2 = glm::dot(p, p);
      sum += std::max(p.z, 0.0) * -glm::dot(p, area) / (d2 * d2 * n * n);
    }
  }
  return sum;
}

TEST(PolygonIrradiance, ParallelRectangle) {
  for (const auto& [a, b, c] : {std::array{1.0, 1.0, 1.0}, std::array{3.0, 0.2, 0.7},
                                std::array{0.01, 0.02, 5.0}, std::array{100.0, 80.0, 0.5}}) {
    const double truth = cornerParallel(a, b, c);
    EXPECT_NEAR(projectedSolidAngle(parallelQuad(a, b, c), kOrigin, kUp), truth,
                1e-13 + 1e-9 * truth)
        << a << " " << b << " " << c;
  }
  // 4 x 0.1385: the textbook view factor of a unit square's corner point at unit distance, over pi.
  EXPECT_NEAR(cornerParallel(1, 1, 1) / glm::pi<double>(), 0.1385, 5e-5);
}

TEST(PolygonIrradiance, UprightRectangleIsCutByNothingButTouchesTheHorizon) {
  for (const auto& [a, b, c] : {std::array{1.0, 1.0, 1.0}, std::array{0.3, 2.0, 0.5}}) {
    const std::vector<glm::dvec3> wall{{0, c, 0}, {0, c, a}, {b, c, a}, {b, c, 0}};
    EXPECT_NEAR(std::abs(projectedSolidAngle(wall, kOrigin, kUp)), cornerUpright(a, b, c), 1e-13);
    // The wall sunk into the ground: the part below the horizon adds nothing.
    const std::vector<glm::dvec3> sunk{{0, c, -2}, {0, c, a}, {b, c, a}, {b, c, -2}};
    EXPECT_NEAR(std::abs(projectedSolidAngle(sunk, kOrigin, kUp)), cornerUpright(a, b, c), 1e-13);
  }
}

TEST(PolygonIrradiance, SignIsTheSideSeen) {
  std::vector<glm::dvec3> quad = parallelQuad(1.0, 1.0, 1.0);
  const double front = projectedSolidAngle(quad, kOrigin, kUp);
  EXPECT_GT(front, 0.0);
  std::reverse(quad.begin(), quad.end());
  EXPECT_DOUBLE_EQ(projectedSolidAngle(quad, kOrigin, kUp), -front);
  EXPECT_EQ(projectedSolidAngle(quad, kOrigin, -kUp), 0.0) << "below the horizon";
}

TEST(PolygonIrradiance, WholeHemisphereIsPi) {
  const double s = 1e7;
  const std::vector<glm::dvec3> sky{{-s, -s, 1}, {-s, s, 1}, {s, s, 1}, {s, -s, 1}};
  EXPECT_NEAR(projectedSolidAngle(sky, kOrigin, kUp), glm::pi<double>(), 1e-9);
}

TEST(PolygonIrradiance, RandomPosesAgainstQuadrature) {
  std::mt19937_64 random(7);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * double(random() >> 11) * 0x1p-53;
  };
  int cut = 0, hidden = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const glm::dvec3 corner(draw(-2, 2), draw(-2, 2), draw(-1, 2.5));
    const glm::dvec3 u(draw(-1, 1), draw(-1, 1), draw(-1, 1)),
        v(draw(-1, 1), draw(-1, 1), draw(-1, 1));
    const std::vector<glm::dvec3> quad{corner, corner + u, corner + u + v, corner + v};
    // Quadrature is inaccurate close to the quad or its plane.
    const glm::dvec3 n = glm::cross(u, v);
    if (std::abs(glm::dot(corner, n)) < 0.5 * glm::length(n)) continue;
    const double truth = quadrature(corner, u, v, 1200);
    const double lambert = projectedSolidAngle(quad, kOrigin, kUp);
    EXPECT_NEAR(lambert, truth, 2e-5) << "trial " << trial;
    const size_t corners = clipToHorizon(quad, kOrigin, kUp).size();
    const bool isWhole = std::min({quad[0].z, quad[1].z, quad[2].z, quad[3].z}) >= 0.0;
    if (corners == 0) ++hidden;
    if (corners > 0 && !isWhole) ++cut;
  }
  EXPECT_GE(cut, 10) << "the horizon was not exercised";
  EXPECT_GE(hidden, 5);
}

TEST(PolygonIrradiance, SumOfPartsIsTheWhole) {
  const std::vector<glm::dvec3> whole{{-1, -1, 0.4}, {-1, 1, 0.4}, {1, 1, 0.9}, {1, -1, 0.9}};
  const glm::dvec3 center = 0.25 * (whole[0] + whole[1] + whole[2] + whole[3]);
  double sum = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    sum += projectedSolidAngle({whole[i], whole[(i + 1) % 4], center}, kOrigin, kUp);
  }
  EXPECT_NEAR(sum, projectedSolidAngle(whole, kOrigin, kUp), 1e-14);
}

}  // namespace
}  // namespace restlab::analytic
