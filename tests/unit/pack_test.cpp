// Packing of numbers into fewer bits: the error after unpacking, and that packing twice changes
// nothing more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/dialect_context.h"

namespace restlab::unit {
namespace {

class Pack : public ::testing::Test {
 protected:
  // Positive number of any magnitude that a float has.
  float positive() { return std::ldexp(1.0f + unit_(rng_), int(unit_(rng_) * 250.0f) - 125); }
  float sign() { return unit_(rng_) < 0.5f ? -1.0f : 1.0f; }
  glm::vec3 direction() {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(rng_), normal(rng_), normal(rng_)));
  }
  Dialect<0> dialect_;
  std::mt19937 rng_{7};
  std::uniform_real_distribution<float> unit_;
};

float offBy(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 relative = glm::abs(a - b) / glm::abs(b);
  return std::max({relative.x, relative.y, relative.z});
}

TEST_F(Pack, ThreePositiveNumbers) {
  double sum = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const glm::vec3 v(positive(), positive(), positive());
    const glm::uvec2 packed = dialect_->packPositive3(v);
    const glm::vec3 back = dialect_->unpackPositive3(packed.x, packed.y);
    ASSERT_LE(offBy(back, v), 6.11e-5f);
    ASSERT_EQ(dialect_->packPositive3(back), packed);
    sum += double(back.y / v.y) - 1.0;
  }
  EXPECT_LT(std::abs(sum / 100000), 1e-6) << "rounding favours a side";
}

TEST_F(Pack, ThreeNumbersWithSigns) {
  for (int i = 0; i < 100000; ++i) {
    const glm::vec3 v(sign() * positive(), sign() * positive(), sign() * positive());
    const glm::uvec2 packed = dialect_->packSigned3(v);
    const glm::vec3 back = dialect_->unpackSigned3(packed.x, packed.y);
    ASSERT_LE(offBy(back, v), 1.222e-4f);
    ASSERT_EQ(dialect_->packSigned3(back), packed);
  }
}

// Non-finite values must stay non-finite after packing; zero stays zero.
TEST_F(Pack, ZeroAndWhatIsNotFinite) {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  for (const float bad : {infinity, nan, -nan}) {
    const glm::uvec2 p = dialect_->packPositive3({1.0f, bad, 0.0f});
    const glm::uvec2 s = dialect_->packSigned3({1.0f, bad, 0.0f});
    EXPECT_FALSE(std::isfinite(dialect_->unpackPositive3(p.x, p.y).y));
    EXPECT_FALSE(std::isfinite(dialect_->unpackSigned3(s.x, s.y).y));
    EXPECT_EQ(dialect_->unpackPositive3(p.x, p.y).z, 0.0f);
    EXPECT_EQ(dialect_->unpackPositive3(p.x, p.y).x, 1.0f);
    EXPECT_EQ(dialect_->unpackSigned3(s.x, s.y).z, 0.0f);
  }
}

TEST_F(Pack, NumbersBelowOne) {
  for (int i = 0; i < 100000; ++i) {
    const float x = unit_(rng_);
    const uint32_t packed = dialect_->packUnorm24(x);
    ASSERT_LT(packed, 1u << 24);
    ASSERT_LE(std::abs(dialect_->unpackUnorm24(packed) - x), 6.0e-8f);
    ASSERT_EQ(dialect_->packUnorm24(dialect_->unpackUnorm24(packed)), packed);
  }
  EXPECT_EQ(dialect_->unpackUnorm24(dialect_->packUnorm24(0.0f)), 0.0f);
  EXPECT_LT(dialect_->packUnorm24(1.0f), 1u << 24);
}

TEST_F(Pack, UnitVectors) {
  float worst = 0.0f, worstNormal = 0.0f;
  const auto test = [&](const glm::vec3& n) {
    const glm::uvec2 packed = dialect_->packUnit22(n);
    const glm::vec3 unpacked = dialect_->unpackUnit22(packed.x, packed.y);
    worst = std::max(worst, glm::distance(unpacked, n));
    ASSERT_EQ(dialect_->packUnit22(unpacked), packed);
    const uint32_t small = dialect_->packNormal(n);
    worstNormal = std::max(worstNormal, glm::distance(dialect_->unpackNormal(small), n));
  };
  for (int i = 0; i < 100000; ++i) test(direction());
  for (const float s : {-1.0f, 1.0f}) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 n(0.0f);
      n[axis] = s;
      test(n);
      n[(axis + 1) % 3] = s;
      test(glm::normalize(n));
    }
  }
  // Half a step on both axes, 2.4e-7, grows by sqrt(18) at most; rounding adds half of that.
  EXPECT_LT(worst, 1.5e-6f);
  EXPECT_LT(worstNormal, 1e-4f);
  const glm::uvec2 none = dialect_->packUnit22(glm::vec3(0.0f));
  EXPECT_LT(glm::distance(dialect_->unpackUnit22(none.x, none.y), glm::vec3(0.0f, 0.0f, 1.0f)),
            6e-7f);
}

TEST_F(Pack, Colors) {
  for (int i = 0; i < 10000; ++i) {
    const glm::vec3 c(unit_(rng_), unit_(rng_), unit_(rng_));
    const uint32_t packed = dialect_->packColor(c);
    EXPECT_EQ(packed >> 30, 0u);
    ASSERT_LT(glm::length(dialect_->unpackColor(packed) - c), 1e-3f);
    ASSERT_EQ(dialect_->packColor(dialect_->unpackColor(packed)), packed);
  }
}

}  // namespace
}  // namespace restlab::unit
