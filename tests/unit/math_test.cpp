// Small functions of the dialect against arithmetic of higher precision; frames and warps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

TEST(Math, MulHighIsTheUpperWord) {
  Dialect<0> d;
  Inputs inputs(1);
  auto check = [&](uint32_t a, uint32_t b) {
    EXPECT_EQ(d->rlMulHigh(a, b), static_cast<uint32_t>(uint64_t(a) * b >> 32)) << a << " x " << b;
  };
  const uint32_t corners[] = {0u,          1u,          0xffffu,     0x10000u, 0x10001u,
                              0x7fffffffu, 0x80000000u, 0xfffffffeu, ~0u};
  for (uint32_t a : corners) {
    for (uint32_t b : corners) check(a, b);
  }
  for (int i = 0; i < 1'000'000; ++i) check(inputs.bits(), inputs.bits());
}

TEST(Math, CosSin2PiWithinAMillionth) {
  Dialect<0> d;
  double worst = 0.0, worstNorm = 0.0;
  auto check = [&](float u) {
    const glm::vec2 cs = d->rlCosSin2Pi(u);
    const double angle = 2.0 * kPi * double(u);
    worst = std::max({worst, std::abs(cs.x - std::cos(angle)), std::abs(cs.y - std::sin(angle))});
    worstNorm = std::max(worstNorm, std::abs(std::hypot(double(cs.x), double(cs.y)) - 1.0));
  };
  for (uint32_t i = 0; i < (1u << 24); i += 5) check(float(i) * 0x1p-24f);
  for (float eighth = 0.125f; eighth < 1.0f; eighth += 0.125f) {
    check(eighth);
    check(std::nextafter(eighth, 0.0f));
    check(std::nextafter(eighth, 1.0f));
  }
  check(1.0f - 0x1p-24f);
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worstNorm, 1e-6);
}

TEST(Math, FinitenessSeesEveryKindOfNumber) {
  Dialect<0> d;
  const float inf = std::numeric_limits<float>::infinity(),
              nan = std::numeric_limits<float>::quiet_NaN();
  for (float x : {0.0f, -0.0f, 1e-45f, -3.4e38f, 3.4e38f}) EXPECT_TRUE(d->rlIsFinite(x)) << x;
  for (float x : {inf, -inf, nan, -nan}) EXPECT_FALSE(d->rlIsFinite(x)) << x;
  EXPECT_TRUE(d->rlIsFinite3(glm::vec3(1.0f, -2.0f, 0.0f)));
  for (int i = 0; i < 3; ++i) {
    for (float x : {inf, -inf, nan}) {
      glm::vec3 v(1.0f);
      v[i] = x;
      EXPECT_FALSE(d->rlIsFinite3(v));
    }
  }
  EXPECT_FALSE(d->rlIsFinite3(glm::vec3(inf, -inf, 0.0f)));
}

TEST(Math, LuminanceOfRec709) {
  Dialect<0> d;
  EXPECT_NEAR(d->rlLuminance(glm::vec3(1.0f)), 1.0f, 1e-6f);
  // Expected: Y row of the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and D65.
  EXPECT_NEAR(d->rlLuminance(glm::vec3(1, 0, 0)), 0.2126390, 1e-6);
  EXPECT_NEAR(d->rlLuminance(glm::vec3(0, 1, 0)), 0.7151687, 1e-6);
  EXPECT_NEAR(d->rlLuminance(glm::vec3(0, 0, 1)), 0.0721923, 1e-6);
}

TEST(Math, SafeDivideOnlyGuardsZero) {
  Dialect<0> d;
  EXPECT_EQ(d->rlSafeDivide(3.0f, 2.0f), 1.5f);
  EXPECT_EQ(d->rlSafeDivide(-3.0f, 2.0f), -1.5f);
  EXPECT_EQ(d->rlSafeDivide(3.0f, 0.0f), 0.0f);
  EXPECT_EQ(d->rlSafeDivide(3.0f, -0.0f), 0.0f);
}

void expectOrthonormal(const glm::vec3& n) {
  Dialect<0> d;
  glm::vec3 t, b;
  d->frameFromNormal(n, t, b);
  const glm::dvec3 N(n), T(t), B(b);
  EXPECT_NEAR(glm::dot(T, T), 1.0, 2e-6);
  EXPECT_NEAR(glm::dot(B, B), 1.0, 2e-6);
  EXPECT_NEAR(glm::dot(T, B), 0.0, 2e-6);
  EXPECT_NEAR(glm::dot(T, N), 0.0, 2e-6);
  EXPECT_NEAR(glm::dot(B, N), 0.0, 2e-6);
  EXPECT_NEAR(glm::dot(glm::cross(T, B), N), 1.0, 2e-6) << "left-handed";
  EXPECT_NEAR(glm::distance(d->frameToWorld(n, {0.0f, 0.0f, 1.0f}), n), 0.0f, 1e-6f);
}

TEST(Frame, OrthonormalForEveryNormal) {
  Inputs inputs(2);
  for (int i = 0; i < 100'000; ++i) {
    expectOrthonormal(inputs.direction());
    if (testing::Test::HasFailure()) break;
  }
  for (float z : {1.0f, -1.0f}) {
    for (float zero : {0.0f, -0.0f}) {
      expectOrthonormal({zero, zero, z});
      expectOrthonormal({z, zero, zero});
      expectOrthonormal({zero, z, zero});
    }
    for (float tiny : {1e-8f, 1e-5f, 1e-4f, 1e-3f}) {
      expectOrthonormal(glm::vec3(glm::normalize(glm::dvec3(tiny, -tiny, z))));
    }
  }
}

TEST(Frame, LocalAndWorldAreInverse) {
  Dialect<0> d;
  Inputs inputs(3);
  for (int i = 0; i < 100'000; ++i) {
    const glm::vec3 n = inputs.direction(), v = inputs.direction();
    const glm::vec3 local = d->frameToLocal(n, v);
    EXPECT_NEAR(local.z, glm::dot(n, v), 1e-6f);
    EXPECT_LT(glm::distance(d->frameToWorld(n, local), v), 2e-6f);
  }
}

TEST(Warp, CosineHemisphere) {
  Dialect<0> d;
  Inputs inputs(4);
  constexpr int n = 32;
  std::vector<uint64_t> counts(n * n);
  for (int i = 0; i < 2'000'000; ++i) {
    const glm::vec3 w = d->warpCosineHemisphere(inputs.square());
    ASSERT_NEAR(glm::dot(w, w), 1.0f, 2e-6f);
    ASSERT_GE(w.z, 0.0f);
    // The cosine-weighted measure is uniform over sin^2 and azimuth.
    const double s2 = double(w.x) * w.x + double(w.y) * w.y;
    const double turn = std::atan2(double(w.y), double(w.x)) / (2.0 * kPi) + 0.5;
    ++counts[std::min(int(s2 * n), n - 1) * n + std::min(int(turn * n), n - 1)];
  }
  expectUniform(counts, "cosine hemisphere");
}

TEST(Warp, TriangleIsUniformOverItsArea) {
  Dialect<0> d;
  Inputs inputs(5);
  // Cells: n^2 congruent small triangles, the two halves of each cell of the barycentric grid.
  constexpr int n = 24;
  std::vector<uint64_t> counts(n * n);
  for (int i = 0; i < 2'000'000; ++i) {
    const glm::vec2 b = d->warpTriangle(inputs.square());
    ASSERT_GE(b.x, 0.0f);
    ASSERT_GE(b.y, 0.0f);
    ASSERT_LE(b.x + b.y, 1.0f + 1e-6f);
    const double x = double(b.x) * n, y = double(b.y) * n;
    const int ix = std::min(int(x), n - 1), iy = std::min(int(y), n - 1 - ix);
    const bool upper = x - ix + (y - iy) > 1.0 && ix + iy < n - 1;
    // Row ix has n - ix lower and n - ix - 1 upper triangles.
    const int first = ix * n * 2 - ix * ix;
    ++counts[size_t(first + (upper ? n - ix + iy : iy))];
  }
  expectUniform(counts, "triangle");
}

}  // namespace
}  // namespace restlab::unit
