// Settings of a session, for every integrator: bounces, components, pixel filter, Russian roulette.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bias/test_cameras.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

class LightTransport : public ::testing::TestWithParam<Variant> {};
class UnbiasedTransport : public ::testing::TestWithParam<Variant> {};

constexpr size_t kRuns = 128;

bias::Method boxMethod(const Variant& variant) {
  bias::Method method = methodOf(variant, 10, 2);
  method.cameras = {bias::cornellBelowTheLamp()};
  return method;
}

// Shows only emission: black or the lamp's colour. With the filter at the pixel's centre the seed
// does not matter.
TEST_P(LightTransport, NoScatteringEventShowsEmissionAlone) {
  SessionConfig config = configOf(GetParam(), 64, 64);
  config.maxBounces = 0;
  config.pixelFilter = rl::RL_FILTER_CENTER;
  const auto scene = bias::builtinScene("cornell-box");
  const Image image = render(scene, config, 2);
  const glm::vec3 lamp(17.0f, 12.0f, 4.0f);
  size_t lit = 0;
  for (const glm::vec3& p : image.pixels) {
    EXPECT_TRUE(p == glm::vec3(0.0f) || p == lamp) << p.x << " " << p.y << " " << p.z;
    lit += p == lamp;
  }
  EXPECT_GT(lit, 20u);
  EXPECT_LT(lit, 400u);
  config.seed = 99;
  EXPECT_EQ(countDifferent(image, render(scene, config, 2)), 0u);
}

// The box filter covers the lamp's outline partly; the mean over frames is the coverage.
TEST_P(LightTransport, BoxFilterCoversThePixel) {
  SessionConfig config = configOf(GetParam(), 64, 64);
  config.maxBounces = 0;
  Session session(bias::builtinScene("cornell-box"), config);
  Image mean(config.width, config.height);
  constexpr int kMeans = 256;
  for (int i = 0; i < kMeans; ++i) {
    session.reset(uint32_t(100 + i));
    session.frame();
    for (size_t p = 0; p < mean.pixels.size(); ++p) {
      mean.pixels[p] += session.radiance().pixels[p] * (1.0f / kMeans);
    }
  }
  const auto partly = std::count_if(mean.pixels.begin(), mean.pixels.end(),
                                    [](const glm::vec3& p) { return p.x > 1.0f && p.x < 16.0f; });
  EXPECT_GT(partly, 8) << "no pixel shows a part of the lamp";
}

// One scattering event is direct light, whether set by maxBounces or by components.
TEST_P(LightTransport, OneScatteringEventIsDirectLight) {
  const auto scene = bias::builtinScene("cornell-box");
  SessionConfig one = configOf(GetParam());
  one.maxBounces = 1;
  SessionConfig direct = configOf(GetParam());
  direct.components = rl::RL_COMPONENT_DIRECT;
  EXPECT_EQ(countDifferent(render(scene, one, 4), render(scene, direct, 4)), 0u);
  SessionConfig indirect = one;
  indirect.components = rl::RL_COMPONENT_INDIRECT;
  const Image none = render(scene, indirect, 4);
  EXPECT_EQ(countDifferent(none, Image(one.width, one.height)), 0u)
      << "indirect light of one event";
}

TEST_P(UnbiasedTransport, ComponentsAddUp) {
  const auto scene = bias::builtinScene("cornell-box");
  const bias::Method all = boxMethod(GetParam());
  bias::Method direct = all, indirect = all;
  direct.config.components = rl::RL_COMPONENT_DIRECT;
  indirect.config.components = rl::RL_COMPONENT_INDIRECT;
  const stats::Truth whole = stats::truthOf(bias::independentRuns(scene, all, 1, kRuns));
  const auto sums = [&](uint32_t seed) {
    return bias::independentSums(scene, {direct, indirect}, seed, kRuns);
  };
  const stats::BiasReport report =
      stats::testBias(sums(1'000), whole, {}, [&] { return sums(2'000); });
  std::printf("%s\n", bias::describe("direct + indirect, " + GetParam().name(), report).c_str());
  EXPECT_FALSE(report.failed()) << report.text();
}

void expectRouletteLeavesTheMean(const std::string& sceneName, bias::Method off, size_t runs) {
  const auto scene = bias::builtinScene(sceneName);
  bias::Method on = off;
  on.config.russianRoulette = true;
  on.name += ", Russian roulette";
  const stats::Truth truth = stats::truthOf(bias::independentRuns(scene, off, 1, runs));
  const stats::BiasReport report = bias::testMethod(scene, on, truth, runs);
  EXPECT_FALSE(report.failed()) << report.text();
}

TEST_P(UnbiasedTransport, RussianRouletteLeavesTheMean) {
  expectRouletteLeavesTheMean("cornell-box", boxMethod(GetParam()), kRuns);
}

// Caustics and highlights have distributions too skewed for a few hundred runs.
TEST_P(UnbiasedTransport, NightlyRussianRouletteLeavesTheMean) {
  for (const char* scene : {"glass", "glossy-gallery"}) {
    bias::Method method = methodOf(GetParam(), 24, 2);
    method.config.threads = 0;
    expectRouletteLeavesTheMean(scene, method, 1024);
  }
}

// Russian roulette must have an effect, too.
TEST_P(LightTransport, RussianRouletteSavesRays) {
  if (GetParam().leavesLightOut()) GTEST_SKIP() << "no long paths";
  const auto scene = bias::builtinScene("cornell-box");
  SessionConfig config = configOf(GetParam());
  Session off(scene, config);
  config.russianRoulette = true;
  Session on(scene, config);
  EXPECT_LT(double(on.frame().raysPath), 0.9 * double(off.frame().raysPath));
}

INSTANTIATE_TEST_SUITE_P(Every, LightTransport, ::testing::ValuesIn(byDay(allVariants())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, LightTransport, ::testing::ValuesIn(byNight(allVariants())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Every, UnbiasedTransport,
                         ::testing::ValuesIn(meansByDay(unbiasedVariants())), VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, UnbiasedTransport,
                         ::testing::ValuesIn(meansByNight(unbiasedVariants())), VariantName());

}  // namespace
}  // namespace restlab::conformance
