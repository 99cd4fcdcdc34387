// The counter-based generator: range, repeatability, uniformity and independence of keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

constexpr uint32_t kCells = 256;

struct RngTest : testing::Test {
  Dialect<0> d;

  float draw(uint32_t seed, uint32_t pixel, uint32_t frame, uint32_t vertex, uint32_t dimension) {
    rl::Rng rng = d->rngInit(seed, pixel, frame);
    rng.vertex = vertex;
    return d->rngDraw(rng, dimension);
  }
};

uint32_t cell(float u) { return static_cast<uint32_t>(u * float(kCells)); }

TEST_F(RngTest, DrawsLieInTheHalfOpenUnitInterval) {
  float low = 1.0f, high = 0.0f;
  for (uint32_t i = 0; i < 4'000'000; ++i) {
    const float u = draw(1, i & 0xffffu, i >> 16, 1, i % rl::RL_DIMENSIONS);
    low = std::min(low, u);
    high = std::max(high, u);
  }
  EXPECT_GE(low, 0.0f);
  EXPECT_LT(high, 1.0f);
  EXPECT_LT(low, 1e-5f);
  EXPECT_GT(high, 1.0f - 1e-5f);
}

TEST_F(RngTest, SameKeySameDraw) {
  Inputs inputs(11);
  for (int i = 0; i < 1000; ++i) {
    const uint32_t seed = inputs.bits(), pixel = inputs.bits(), frame = inputs.bits();
    const uint32_t vertex = inputs.below(0x4000), dimension = inputs.below(rl::RL_DIMENSIONS);
    EXPECT_EQ(draw(seed, pixel, frame, vertex, dimension),
              draw(seed, pixel, frame, vertex, dimension));
  }
}

// Known answers, computed from the definition in 64-bit arithmetic: the stream is part of the
// contract "same seed, same image".
TEST_F(RngTest, MatchesItsDefinition) {
  auto hash = [](uint64_t x) {
    x &= 0xffffffffu;
    x ^= x >> 16;
    x = x * 0x7feb352du & 0xffffffffu;
    x ^= x >> 15;
    x = x * 0x846ca68bu & 0xffffffffu;
    return x ^ x >> 16;
  };
  EXPECT_EQ(d->rngHash(0u), 0u);
  for (uint32_t x : {1u, 2u, 0x12345678u, 0xffffffffu}) EXPECT_EQ(d->rngHash(x), hash(x));
  const rl::Rng rng = d->rngInit(7, 123456, 31);
  const uint64_t h = hash(hash(7 + 0x9e3779b9ull) ^ 31);
  EXPECT_EQ(rng.key.x, hash(h + 123456));
  EXPECT_EQ(rng.key.y, hash((h ^ 0x85ebca6b) + 123456 * 0x9e3779b9ull));
  EXPECT_EQ(rng.vertex, rl::RL_VERTEX_PIXEL);
  rl::Rng at = rng;
  at.vertex = 3;
  EXPECT_EQ(d->rngBits(at, 5), hash(hash((3 * rl::RL_DIMENSIONS + 5) ^ rng.key.x) + rng.key.y));
}

TEST_F(RngTest, UniformAlongEveryAxis) {
  struct Axis {
    const char* name;
    uint32_t seed, pixel, frame, vertex, dimension;
  };
  const std::vector<Axis> axes = {{"seeds", 1, 0, 0, 0, 0},
                                  {"pixels", 0, 1, 0, 0, 0},
                                  {"frames", 0, 0, 1, 0, 0},
                                  {"pixels and frames", 0, 1, 1, 0, 0},
                                  {"vertices", 0, 0, 0, 1, 0}};
  for (const Axis& a : axes) {
    std::vector<uint64_t> counts(kCells);
    for (uint32_t i = 0; i < 1'000'000; ++i) {
      ++counts[cell(draw(5 + i * a.seed, 9 + i * a.pixel, i * a.frame, 1 + i * a.vertex, 7))];
    }
    expectUniform(counts, a.name);
  }
  for (uint32_t dimension = 0; dimension < rl::RL_DIMENSIONS; dimension += 7) {
    std::vector<uint64_t> counts(kCells);
    for (uint32_t i = 0; i < 1'000'000; ++i)
      ++counts[cell(draw(1, i & 0x3ffu, i >> 10, 2, dimension))];
    expectUniform(counts, "dimension " + std::to_string(dimension));
  }
}

TEST_F(RngTest, LowBitsAreUniformToo) {
  std::vector<uint64_t> counts(kCells);
  for (uint32_t i = 0; i < 1'000'000; ++i) {
    const rl::Rng rng = d->rngInit(3, i, 0);
    ++counts[d->rngBits(rng, 4) & 255u];
  }
  expectUniform(counts, "low byte");
}

// Pairs of draws that a renderer uses together must fill the square evenly.
TEST_F(RngTest, PairsAreIndependent) {
  struct Pair {
    const char* name;
    uint32_t seed, pixel, frame, vertex, dimension;  // second draw, relative to the first
  };
  const std::vector<Pair> pairs = {{"next dimension", 0, 0, 0, 0, 1},
                                   {"next vertex", 0, 0, 0, 1, 0},
                                   {"next pixel", 0, 1, 0, 0, 0},
                                   {"next row", 0, 320, 0, 0, 0},
                                   {"next frame", 0, 0, 1, 0, 0},
                                   {"next seed", 1, 0, 0, 0, 0},
                                   {"one dimension, one vertex", 0, 0, 0, 1, 63},
                                   {"frame against seed", ~0u, 0, 1, 0, 0}};
  constexpr uint32_t n = 32;
  for (const Pair& p : pairs) {
    std::vector<uint64_t> counts(n * n);
    for (uint32_t i = 0; i < 1'000'000; ++i) {
      const uint32_t pixel = i & 0x3fffu, frame = i >> 14;
      const float u = draw(17, pixel, frame, 1, rl::RL_DIM_BSDF_U);
      const float v = draw(17 + p.seed, pixel + p.pixel, frame + p.frame, 1 + p.vertex,
                           rl::RL_DIM_BSDF_U + p.dimension);
      ++counts[static_cast<uint32_t>(u * float(n)) * n + static_cast<uint32_t>(v * float(n))];
    }
    expectUniform(counts, p.name);
  }
}

// Serial test over the order in which a kernel draws: dimensions of consecutive vertices of a path.
TEST_F(RngTest, SerialTriplesOfAPathAreIndependent) {
  constexpr uint32_t n = 12;
  std::vector<uint64_t> counts(n * n * n);
  for (uint32_t pixel = 0; pixel < 50'000; ++pixel) {
    rl::Rng rng = d->rngInit(23, pixel, 4);
    std::array<uint32_t, 63> draws;
    for (uint32_t i = 0; i < draws.size(); ++i) {
      rng.vertex = 1 + i / 9;
      draws[i] = static_cast<uint32_t>(d->rngDraw(rng, 2 + i % 9) * float(n));
    }
    for (uint32_t i = 0; i < draws.size(); i += 3) {
      ++counts[(draws[i] * n + draws[i + 1]) * n + draws[i + 2]];
    }
  }
  expectUniform(counts, "triples");
}

// Pixels of a frame must not share their whole key: they would draw the same path.
TEST_F(RngTest, KeysOfAFrameAreDistinct) {
  for (uint32_t frame : {0u, 1u, 99u}) {
    std::vector<uint64_t> keys;
    for (uint32_t pixel = 0; pixel < 300'000; ++pixel) {
      const rl::Rng rng = d->rngInit(1, pixel, frame);
      keys.push_back(uint64_t(rng.key.x) << 32 | rng.key.y);
    }
    std::sort(keys.begin(), keys.end());
    EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  }
}

}  // namespace
}  // namespace restlab::unit
