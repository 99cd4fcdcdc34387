// Thousands of frames of one history: the energy must not drift. Nothing may accumulate over frames
// in reservoirs, entries of a cache or the age of a view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/frame/cache.h"
#include "experiments/statistics/welch.h"
#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"

namespace restlab::bias {
namespace {

struct History {
  std::string integrator, cache, mode;
  bool isTurning;
};

// Caches and modes only matter with a moving camera: in a still view they render one image
// (tests/conformance/still_view_test.cpp).
std::vector<History> histories(const std::vector<std::string>& modes) {
  std::vector<History> all = {{"restir_gi", cacheRegistry().front()->name, "unbiased", false}};
  for (const CacheInfo* cache : cacheRegistry())
    for (const std::string& mode : modes) all.push_back({"restir_gi", cache->name, mode, true});
  return all;
}

std::string nameOf(const History& h) {
  return h.cache + "_" + h.mode + (h.isTurning ? "_turning" : "_still");
}
void PrintTo(const History& h, std::ostream* out) { *out << nameOf(h); }

// Returns the relative change of the energy per decade of frames: the slope of a least squares line
// through the means of the frames 1 to 9, 10 to 99, ...
double slopeOf(const std::vector<double>& energies) {
  std::vector<double> means;
  for (size_t begin = 1; begin <= energies.size(); begin *= 10) {
    const size_t end = std::min(10 * begin, energies.size() + 1);
    if (2 * (end - begin) < begin) break;  // skip an incomplete decade
    double sum = 0.0;
    for (size_t frame = begin; frame < end; ++frame) sum += energies[frame - 1];
    means.push_back(sum / double(end - begin));
  }
  const double middle = 0.5 * double(means.size() - 1);
  double up = 0.0, down = 0.0, level = 0.0;
  for (size_t i = 0; i < means.size(); ++i) {
    const double x = double(i) - middle;
    up += x * means[i];
    down += x * x;
    level += means[i] / double(means.size());
  }
  return up / down / level;
}

// Returns the energies of a history's frames in the furnace, whose image is the same from
// everywhere.
std::vector<double> energiesOf(Session& session, const History& history, uint32_t seed,
                               uint32_t frames) {
  const SceneCamera camera = makeBuiltinScene("furnace").cameras.at(0);
  const std::vector<SceneCamera> cameras = walkTo(camera, frames, glm::dvec3(0.0), 0.7);
  session.reset(seed);
  std::vector<double> energies;
  for (uint32_t frame = 0; frame < frames; ++frame) {
    session.setCamera(history.isTurning ? cameras[frame] : camera);
    session.frame();
    double sum = 0.0;
    for (const glm::vec3& pixel : session.radiance().pixels) sum += double(pixel.y);
    energies.push_back(sum);
  }
  return energies;
}

// Slope over runs of other seeds.
struct Slope {
  double mean = 0.0, half = 0.0;  // half width of the 99.9 % interval: several histories are tested
  bool isZero() const { return std::abs(mean) <= half; }
};

// `drift`: artificial drift per decade of frames.
Slope slopeOf(Session& session, const History& history, uint32_t firstSeed, uint32_t frames,
              uint32_t runs, double drift = 0.0) {
  std::vector<double> slopes;
  for (uint32_t run = 0; run < runs; ++run) {
    std::vector<double> energies = energiesOf(session, history, firstSeed + run, frames);
    for (size_t frame = 1; frame <= energies.size(); ++frame)
      energies[frame - 1] *= 1.0 + drift * std::log10(double(frame));
    slopes.push_back(slopeOf(energies));
  }
  const stats::Sample sample = stats::summarise(slopes);
  const double error = std::sqrt(sample.variance / sample.n);
  return {sample.mean, stats::studentQuantile(1.0 - 0.5e-3, sample.n - 1.0) * error};
}

SessionConfig configOf(const History& history) {
  SessionConfig config = pathMethod(1).config;
  config.integrator = history.integrator;
  config.width = 16;
  config.height = 9;
  config.cache = history.cache;
  config.mode = history.mode;
  return config;
}

void expectNoSlope(const History& history, uint32_t frames, uint32_t runs) {
  Session session(builtinScene("furnace"), configOf(history));
  const uint32_t seed = 10'000'000 + seedOffset();
  const Slope first = slopeOf(session, history, seed, frames, runs);
  std::printf("%s, %u frames: slope %+.2f %% a decade, +-%.2f at 99.9 %%\n",
              nameOf(history).c_str(), frames, 100.0 * first.mean, 100.0 * first.half);
  EXPECT_LT(first.half, 0.03) << nameOf(history) << ": says nothing";
  if (first.isZero()) return;
  const Slope fresh = slopeOf(session, history, seed + runs, frames, runs);
  EXPECT_TRUE(fresh.isZero() || (fresh.mean > 0.0) != (first.mean > 0.0))
      << nameOf(history) << ": " << first.mean << ", with other seeds " << fresh.mean;
}

TEST(Slope, OfMadeUpEnergies) {
  std::vector<double> energies;
  for (int frame = 1; frame <= 999; ++frame) energies.push_back(5.0);
  EXPECT_DOUBLE_EQ(slopeOf(energies), 0.0);
  for (int frame = 1; frame <= 999; ++frame)
    energies[size_t(frame) - 1] = frame < 10 ? 99.0 : frame < 100 ? 100.0 : 101.0;
  EXPECT_NEAR(slopeOf(energies), 0.01, 1e-12);
}

// A drift of one percent per decade is found, also with fresh seeds.
TEST(Slope, NightlyOfAPlantedDriftIsFound) {
  const History history = histories({"unbiased"}).front();
  Session session(builtinScene("furnace"), configOf(history));
  for (const uint32_t seed : {40'000'000u, 40'000'100u}) {
    const Slope slope = slopeOf(session, history, seed, 999, 12, 0.01);
    EXPECT_GT(slope.mean, slope.half) << slope.mean << " +- " << slope.half;
  }
}

// Counts false rejections for a method without a history, which has no slope.
TEST(Slope, NightlyOfPathIsRarelyRejected) {
  const History history{"path", "", "", false};
  Session session(builtinScene("furnace"), configOf(history));
  int rejected = 0;
  for (uint32_t i = 0; i < 100; ++i)
    rejected += !slopeOf(session, history, 30'000'000 + 12 * i, 999, 12).isZero();
  std::printf("slopes of path: %d of 100 are rejected\n", rejected);
  EXPECT_LE(rejected, 2) << "at 99.9 %: three are a chance of 1 in 6000";
}

class LongHistory : public ::testing::TestWithParam<History> {};
TEST_P(LongHistory, KeepsItsEnergy) { expectNoSlope(GetParam(), 999, 12); }
INSTANTIATE_TEST_SUITE_P(Last, LongHistory, ::testing::Values(histories({"unbiased"}).back()),
                         [](const auto& test) { return nameOf(test.param); });

class LongHistoryNightly : public ::testing::TestWithParam<History> {};
TEST_P(LongHistoryNightly, KeepsItsEnergy) { expectNoSlope(GetParam(), 9999, 12); }
INSTANTIATE_TEST_SUITE_P(Every, LongHistoryNightly,
                         ::testing::ValuesIn(histories({"unbiased", "biased"})),
                         [](const auto& test) { return nameOf(test.param); });

}  // namespace
}  // namespace restlab::bias
