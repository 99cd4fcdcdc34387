// Reconnection Jacobian compared with central differences of its map.
#define RL_REAL_DOUBLE
#include <gtest/gtest.h>

#include <random>

#include "core/dialect/dialect.h"

namespace rl {
namespace {

struct Shift {
#include "core/resampling/shift.glsl"
  // Jacobian of a reconnection at xk; a factor of the resampling weight.
  double jacobian(dvec3 xk, dvec3 normal, dvec3 source, dvec3 destination) {
    return shiftGeometryTerm(xk, normal, destination) / shiftGeometryTerm(xk, normal, source);
  }
};

dvec3 randomUnit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalize(dvec3(normal(random), normal(random), normal(random)));
}

// Returns the point of the plane (xk, normal) seen from `from` in direction `dir`.
dvec3 hitPlane(dvec3 from, dvec3 dir, dvec3 xk, dvec3 normal) {
  return from + dir * (dot(xk - from, normal) / dot(dir, normal));
}

TEST(ReconnectionJacobian, EqualsFiniteDifferences) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.3, 3.0);
  Shift shift;
  int tested = 0;
  while (tested < 10000) {
    const dvec3 xk = randomUnit(random), normal = randomUnit(random);
    const dvec3 source = xk + uniform(random) * randomUnit(random);
    const dvec3 destination = xk + uniform(random) * randomUnit(random);
    const dvec3 dir = normalize(xk - source);
    if (std::abs(dot(dir, normal)) < 0.05) continue;  // differences would leave the plane
    if (std::abs(dot(normalize(xk - destination), normal)) < 0.05) continue;
    ++tested;
    // Two directions around dir span a solid angle of (2 h)^2 at the source.
    const dvec3 u = normalize(cross(dir, std::abs(dir.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 v = cross(dir, u);
    const double h = 1e-5;
    const auto shifted = [&](const dvec3& offset) {
      return normalize(hitPlane(source, normalize(dir + offset), xk, normal) - destination);
    };
    const dvec3 du = shifted(h * u) - shifted(-h * u);
    const dvec3 dv = shifted(h * v) - shifted(-h * v);
    const double numeric = length(cross(du, dv)) / (4.0 * h * h);
    const double j = shift.jacobian(xk, normal, source, destination);
    ASSERT_NEAR(j / numeric, 1.0, 1e-4);
    // The inverse shift has the inverse Jacobian.
    const double back = shift.jacobian(xk, normal, destination, source);
    ASSERT_NEAR(j * back, 1.0, 1e-12);
  }
}

TEST(ReconnectionJacobian, KnownValuesAndOrientation) {
  Shift shift;
  const dvec3 origin(0.0), up(0.0, 0.0, 1.0);
  EXPECT_NEAR(shift.jacobian(origin, up, {0, 0, 1}, {0, 0, 1}), 1.0, 1e-15);
  // Twice as far along the normal: a quarter of the solid angle, a factor of the weight.
  EXPECT_NEAR(shift.jacobian(origin, up, {0, 0, 1}, {0, 0, 2}), 0.25, 1e-15);
  EXPECT_NEAR(shift.jacobian(origin, up, {0, 0, 1}, {1, 0, 1}), std::sqrt(0.5) / 2.0, 1e-15);
  // Neither the sign of the normal nor the side of the plane matters.
  EXPECT_NEAR(shift.jacobian(origin, -up, {0, 0, 1}, {0, 0, -2}), 0.25, 1e-15);
  // Nothing arrives in the plane of x_k, nor at x_k itself.
  EXPECT_EQ(shift.shiftGeometryTerm(origin, up, {1, 0, 0}), 0.0);
  EXPECT_EQ(shift.shiftGeometryTerm(origin, up, {0, 0, 0}), 0.0);
}

}  // namespace
}  // namespace rl
