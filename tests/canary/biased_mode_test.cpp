// Measures the bias of the mode `biased`: its energy must stay within 5 % of that of the unbiased
// mode, and its squared bias within a quarter of its mean squared error, or its rows would not
// count. The camera walks, because in a still view both modes are the same.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/image/metrics/metrics.h"
#include "tests/bias/few_entries.h"
#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"

namespace restlab::bias {
namespace {

void accumulate(Image& sum, const Image& image, float weight) {
  for (size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += image.pixels[p] * weight;
}

struct Effort {
  uint32_t truthFrames;  // per half
  uint32_t frames;       // per history: the last one is judged
  uint32_t runs;         // even
  int threads;
};

struct Measured {
  double energyRatio = 0.0;
  double mse = 0.0;
  double squaredBias = 0.0;  // may be negative: about 0 for an unbiased method
  double shadowRays = 0.0;   // over all frames
};

std::array<Image, 2> pathHalves(const std::shared_ptr<const CompiledScene>& scene,
                                const SessionConfig& config, uint32_t frames) {
  std::array<Image, 2> halves;
  for (uint32_t h = 0; h < 2; ++h) {
    SessionConfig own = config;
    own.seed = 1 + h;
    Session session(scene, own);
    halves[h] = Image(config.width, config.height);
    for (uint32_t i = 0; i < frames; ++i) {
      session.frame();
      accumulate(halves[h], session.radiance(), 1.0f / float(frames));
    }
  }
  return halves;
}

Measured measure(const std::shared_ptr<const CompiledScene>& scene, const Method& method,
                 uint32_t runs, const std::array<Image, 2>& halves) {
  const uint32_t width = method.config.width, height = method.config.height;
  std::array<Image, 2> means = {Image(width, height), Image(width, height)};
  Measured result;
  Session session(scene, method.config);
  for (uint32_t run = 0; run < runs; ++run) {
    session.reset(1000 + run);
    for (uint32_t frame = 0; frame < method.frames; ++frame) {
      session.setCamera(method.cameras[frame]);
      result.shadowRays += double(session.frame().raysShadow);
    }
    accumulate(means[run % 2], session.radiance(), 2.0f / float(runs));
    result.mse += mseAgainstHalves(session.radiance(), halves[0], halves[1]) / double(runs);
  }
  result.squaredBias = squaredBias(means[0], means[1], halves[0], halves[1]);
  Image mean(width, height), truth(width, height);
  for (uint32_t h = 0; h < 2; ++h) {
    accumulate(mean, means[h], 0.5f);
    accumulate(truth, halves[h], 0.5f);
  }
  const glm::dvec3 m = channelMeans(mean), t = channelMeans(truth);
  result.energyRatio = (m.x + m.y + m.z) / (t.x + t.y + t.z);
  return result;
}

void expectBounded(const Effort& effort, const std::string& cache) {
  const auto scene = builtinScene("door-ajar");
  Method method = restirMethod(effort.frames, 0);
  method.config.cache = cache;
  useFewEntries(method.config);
  method.config.threads = effort.threads;
  method.cameras = walkTo(scene->source().cameras.front(), effort.frames, {0.04, 0.0, -0.03}, -0.5);
  const std::array<Image, 2> halves = pathHalves(scene, pathMethod(1).config, effort.truthFrames);
  std::vector<Measured> measured;
  for (const char* mode : {"biased", "unbiased"}) {
    method.config.mode = mode;
    const Measured m = measure(scene, method, effort.runs, halves);
    std::printf(
        "door-ajar, restir_gi %s, %s: energy ratio %.4f, MSE %.3g, squared bias %.3g (%.1f %%)\n",
        mode, cache.c_str(), m.energyRatio, m.mse, m.squaredBias, 100.0 * m.squaredBias / m.mse);
    EXPECT_GT(m.mse, 0.0) << mode;
    EXPECT_LE(m.squaredBias, 0.25 * m.mse) << mode;
    measured.push_back(m);
  }
  // Compare the energies of equal seeds with and without bias: few runs say little of a single
  // energy.
  const double energy = measured.at(0).energyRatio / measured.at(1).energyRatio;
  EXPECT_GT(energy, 0.95);
  EXPECT_LT(energy, 1.05);
  EXPECT_LT(measured.at(0).shadowRays, 0.95 * measured.at(1).shadowRays)
      << "the biased mode saves no ray";
}

std::vector<std::string> allCaches() {
  std::vector<std::string> names;
  for (const CacheInfo* info : cacheRegistry()) names.push_back(info->name);
  return names;
}

// 32 warm-up frames, as in published tables.
TEST(BiasedMode, StaysWithinItsDeclaredBound) {
  expectBounded({512, 33, 48, 1}, cacheRegistry().front()->name);
}
class BiasedModeNightly : public ::testing::TestWithParam<std::string> {};
TEST_P(BiasedModeNightly, StaysWithinItsDeclaredBound) {
  expectBounded({8192, 33, 512, 0}, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Cache, BiasedModeNightly, ::testing::ValuesIn(allCaches()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace restlab::bias
