// Grids of samples as solids: how near they come to what was sampled, what they are beyond their
// box, and their files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/error.h"
#include "core/scene/field/grid_file.h"
#include "tests/unit/grid_cases.h"
#include "tests/unit/shape_cases.h"

namespace restlab::unit {
namespace {

struct LocalGrid {
  explicit LocalGrid(const FieldProgram& of) {
    ShapeGeometry geometry;
    geometry.words = fieldWords(of);
    words = shapeWords(geometry);
    shape.kind = rl::RL_SHAPE_SDF;
    d.scene.shapeWords.data = words.data();
    field = d->fieldOf(shape);
  }
  std::vector<glm::uvec4> words;
  rl::Shape shape{};
  Dialect<> d;
  rl::Field field{};
};

// Interpolation along one axis is off by h^2 / 8 times the second derivative; the three of a
// distance to a point are 2 / r together. It is never too small.
TEST(FieldGrids, OfASphereLieWithinTheirError) {
  constexpr double kRadius = 0.8;
  for (const int samples : {9, 17, 33, 65}) {
    const double h = 2.0 / (samples - 1), error = h * h / (4.0 * (kRadius - h));
    LocalGrid local(solidOfGrids("grid('a')", {{"a", sphereGrid(samples, 1.0, kRadius)}}));
    Inputs inputs(1);
    double least = 2.0, most = 0.0, worstNormal = 0.0;
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
      const glm::vec3 dir = inputs.direction();
      const glm::vec3 target = float(kRadius) * 0.99f * inputs.uniform() * inputs.direction();
      rl::Hit hit{};
      const bool isHit = local.d->shapeIntersect(local.shape, rayOf(target - 3.0f * dir, dir), hit);
      const double passes = glm::length(target - glm::dot(target, dir) * dir);
      ASSERT_TRUE(isHit || passes >= kRadius - error) << samples << ", ray " << i;
      if (!isHit) continue;
      ++hits;
      const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
      const double r = glm::length(glm::dvec3(p.posL));
      least = std::min(least, r);
      most = std::max(most, r);
      worstNormal = std::max(worstNormal, double(glm::distance(p.normalL, glm::normalize(p.posL))));
    }
    EXPECT_GT(hits, 10'000);
    EXPECT_GE(least, kRadius - error) << samples;
    EXPECT_LE(most, kRadius + 1e-6) << samples;
    // The bound is not far off.
    EXPECT_LE(least, kRadius - 0.3 * error) << samples;
    EXPECT_LE(worstNormal, 1.5 * h / kRadius) << samples;
  }
}

TEST(FieldGrids, BeyondTheBoxTheDistanceIsAdded) {
  const SampledGrid grid = noiseGrid(7, 3);
  const FieldGrid host(grid);
  LocalGrid local(solidOfGrids("grid('a')", {{"a", grid}}));
  Inputs inputs(2);
  for (int i = 0; i < 20'000; ++i) {
    const glm::vec3 p = inputs.scale(0.1f, 5.0f) * inputs.direction();
    const glm::vec3 nearest = glm::clamp(p, glm::vec3(-1.0f), glm::vec3(1.0f));
    const double expected = host.at(glm::dvec3(nearest)) + double(glm::distance(p, nearest));
    const glm::vec3 dir = inputs.direction();
    const glm::vec2 found = local.d->fieldSlope(local.field, p, dir);
    ASSERT_NEAR(host.at(glm::dvec3(p)), expected, 1e-6);
    ASSERT_NEAR(double(found.x), expected, 3e-6);
    const glm::vec4 range = local.d->fieldRange(local.field, p, p + 0.3f * dir, 0.3f * dir);
    const FieldRange hostRange =
        host.over(glm::dvec3(glm::min(p, p + 0.3f * dir)), glm::dvec3(glm::max(p, p + 0.3f * dir)));
    for (int k = 0; k <= 4; ++k) {
      const glm::vec3 at = p + 0.3f * dir * (0.25f * float(k));
      const glm::vec2 v = local.d->fieldSlope(local.field, at, 0.3f * dir);
      ASSERT_TRUE(v.x >= range.x && v.x <= range.y) << i;
      ASSERT_TRUE(v.y >= range.z - 1e-5f && v.y <= range.w + 1e-5f) << i;
      const double value = host.at(glm::dvec3(at));
      ASSERT_TRUE(value >= hostRange.low - 1e-6 && value <= hostRange.high + 1e-6) << i;
    }
  }
}

TEST(FieldGrids, AFileIsKeptOnceAndReadBack) {
  int read = 0;
  const SampledGrid grid = noiseGrid(9, 4);
  const FieldProgram program =
      readSolid("union(grid('a'), translate(3, 0, 0, rotate(0, 0, 1, 20, grid(\"a\"))))", {},
                [&](const std::string&) { return ++read, FieldGrid(grid); });
  EXPECT_EQ(read, 1);
  EXPECT_EQ(program.grids.size(), 1u);
  const std::vector<uint32_t> words = fieldWords(program);
  const FieldProgram back = fieldProgram(words);
  ASSERT_EQ(back.grids.size(), 1u);
  EXPECT_EQ(back.grids[0].size(), program.grids[0].size());
  Inputs inputs(5);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p(
        glm::mix(program.low, program.high, glm::vec3(inputs.square(), inputs.uniform())));
    ASSERT_EQ(back.at(p), program.at(p));
  }
}

TEST(FieldGrids, BelowZeroAtTheirFacesNeedABox) {
  const SampledGrid cut = sphereGrid(9, 0.5, 0.8);
  try {
    solidOfGrids("grid('a')", {{"a", cut}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("give a 'box'"), std::string::npos) << error.what();
  }
  const std::array box{glm::vec3(-0.4f), glm::vec3(0.4f)};
  EXPECT_FALSE(solidOfGrids("grid('a')", {{"a", cut}}, box).isClosed);
}

std::string refusalOf(std::vector<uint8_t> bytes) {
  try {
    readGrid(bytes, "x.vol");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    return error.what();
  }
  return "";
}

TEST(GridFiles, AreReadAsTheyAreWritten) {
  const SampledGrid grid = sampledGrid({3, 4, 5}, {-1.0, 0.5, 2.0}, {1.0, 2.0, 8.0},
                                       [](const glm::dvec3& p) { return p.x + 10.0 * p.y - p.z; });
  const std::vector<uint8_t> bytes = gridBytes(grid);
  ASSERT_EQ(bytes.size(), 48u + 4u * 60u);
  EXPECT_EQ(std::memcmp(bytes.data(), "VOL\3\1\0\0\0\3\0\0\0\4\0\0\0\5\0\0\0\1\0\0\0", 24), 0);
  float second = 0.0f;
  std::memcpy(&second, bytes.data() + 52, 4);
  EXPECT_EQ(second, grid.values[1]) << "x is the fastest";
  const SampledGrid back = readGrid(bytes, "x.vol");
  EXPECT_EQ(back.samples, grid.samples);
  EXPECT_EQ(back.low, grid.low);
  EXPECT_EQ(back.high, grid.high);
  EXPECT_EQ(back.values, grid.values);
}

TEST(GridFiles, ThatAreDamagedAreRefusedWithALine) {
  const std::vector<uint8_t> good = gridBytes(sphereGrid(3, 1.0, 0.5));
  const auto with = [&](size_t at, auto value) {
    std::vector<uint8_t> bytes = good;
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
  };
  const auto expectRefused = [](const std::vector<uint8_t>& bytes, const std::string& part) {
    const std::string line = refusalOf(bytes);
    EXPECT_EQ(line.rfind("x.vol: ", 0), 0u) << line;
    EXPECT_NE(line.find(part), std::string::npos) << line << ", expected " << part;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expectRefused({}, "does not begin with 'VOL'");
  expectRefused({'V', 'O', 'L', 3, 1}, "ends within its header");
  expectRefused(with(0, 'X'), "does not begin with 'VOL'");
  expectRefused(with(3, uint8_t{4}), "version 4; 3 expected");
  expectRefused(with(4, 2), "encoding 2; 1 expected");
  expectRefused(with(20, 3), "3 channels; 1 expected");
  expectRefused(with(8, 1), "1 samples along x; from 2");
  expectRefused(with(12, -5), "-5 samples along y");
  expectRefused(with(16, 1 << 30), "samples along z");
  std::vector<uint8_t> many = with(8, 1 << 12);
  std::memcpy(many.data() + 12, many.data() + 8, 4);
  expectRefused(many, "4096 x 4096 x 3 samples; at most 16777216");
  expectRefused(with(8, 4), "bytes; 192 expected for 4 x 3 x 3 samples");
  expectRefused({good.begin(), good.end() - 1}, "155 bytes; 156 expected");
  std::vector<uint8_t> longer = good;
  longer.push_back(0);
  expectRefused(longer, "157 bytes; 156 expected");
  expectRefused(with(24, nan), "its box reaches from nan");
  expectRefused(with(24, 2.0f), "cells are -0.5 wide along x");
  expectRefused(with(36, 3e7f), "at most 1e+06 expected");
  expectRefused(with(48 + 4 * 5, nan), "sample 5 is nan");
  expectRefused(with(48 + 4 * 26, std::numeric_limits<float>::infinity()), "sample 26 is inf");
  EXPECT_EQ(refusalOf(good), "");
}

}  // namespace
}  // namespace restlab::unit
