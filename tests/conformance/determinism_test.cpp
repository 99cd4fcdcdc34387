// Equal seeds give equal images: for any number of threads, after a reset, and with the general
// kernel.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/conformance/variants.h"
#include "tests/varied_scenes.h"

namespace restlab::conformance {
namespace {

// Enough frames for young histories, an old one, and two of a camera that moves (runFrames).
constexpr uint32_t kFrames = 11;

class Determinism : public ::testing::TestWithParam<Variant> {};

TEST_P(Determinism, OneThreadAndManyThreadsAgreeBitForBit) {
  for (const char* scene : {"door-ajar", "glossy-gallery", "glass", "courtyard"}) {
    SessionConfig config = configOf(GetParam(), 67, 35);  // cuts the tiles at the border
    const Image one = render(bias::builtinScene(scene), config, kFrames);
    config.threads = 5;
    const Image many = render(bias::builtinScene(scene), config, kFrames);
    EXPECT_EQ(countDifferent(one, many), 0u) << scene;
  }
}

TEST_P(Determinism, ResetStartsTheSameHistoryAgain) {
  const auto scene = bias::builtinScene("glossy-gallery");
  SessionConfig config = configOf(GetParam());
  config.seed = 7;
  Session session(scene, config);
  runFrames(session, *scene, kFrames);
  const Image first = session.radiance();
  session.reset(8);
  runFrames(session, *scene, kFrames);
  const Image other = session.radiance();
  session.reset(7);
  runFrames(session, *scene, kFrames);
  EXPECT_EQ(countDifferent(first, session.radiance()), 0u);
  EXPECT_GT(countDifferent(first, other), size_t(config.width) * config.height) << "seed unused";
}

// References continue from a frame number. A method with a history cannot: the history is missing.
TEST_P(Determinism, FramesGoOnFromANumber) {
  const auto scene = bias::builtinScene("glossy-gallery");
  Session session(scene, configOf(GetParam()));
  if (findMethod(session.config()).hasHistory(session.config().parameters)) {
    EXPECT_THROW(session.reset(7, 3), Error);
    EXPECT_NO_THROW(session.reset(7, 0));
    return;
  }
  session.reset(7);
  for (uint32_t i = 0; i < 3; ++i) session.frame();
  const Image third = session.radiance();
  session.frame();
  const Image fourth = session.radiance();
  Session other(scene, configOf(GetParam()));
  other.reset(7, 3);
  other.frame();
  // In a still view guides are averaged over the frames, which shifts a filter's edges slightly.
  if (GetParam().blurs()) return;
  EXPECT_EQ(countDifferent(fourth, other.radiance()), 0u);
  EXPECT_GT(countDifferent(third, other.radiance()), 0u);
}

TEST_P(Determinism, FramesOfOneHistoryDiffer) {
  Session session(bias::builtinScene("cornell-box"), configOf(GetParam()));
  session.frame();
  const Image first = session.radiance();
  session.frame();
  EXPECT_GT(countDifferent(first, session.radiance()), first.pixels.size() / 2);
}

// Both kernels are compiled from the same source; the general one tests at run time what the own
// one knows at compile time. Every selection and every bit must be the same.
void expectOwnKernelsAgree(const Variant& variant, const std::vector<std::string>& scenes) {
  for (const std::string& name : scenes) {
    SessionConfig config = configOf(variant);
    const auto scene = bias::builtinScene(name);
    config.kernels = KernelChoice::general;
    Session general(scene, config);
    config.kernels = KernelChoice::exact;
    Session own(scene, config);
    EXPECT_EQ(general.featuresUsed(), rl::RL_FEATURE_ALL) << name;
    EXPECT_EQ(own.featuresUsed(), own.featuresNeeded()) << name;
    runFrames(general, *scene, kFrames);
    runFrames(own, *scene, kFrames);
    EXPECT_EQ(countDifferent(general.radiance(), own.radiance()), 0u)
        << name << ", " << featureNames(own.featuresUsed());
  }
}

// One scene whose kernels are built in, and one whose kernels are compiled here.
TEST_P(Determinism, OwnKernelsAgreeWithTheGeneralOnes) {
  expectOwnKernelsAgree(GetParam(), {"cornell-box", "courtyard"});
}

class EveryScene : public ::testing::TestWithParam<Variant> {};

TEST_P(EveryScene, OwnKernelsAgreeWithTheGeneralOnesNightly) {
  expectOwnKernelsAgree(GetParam(), test::variedScenes());
}

INSTANTIATE_TEST_SUITE_P(Every, Determinism, ::testing::ValuesIn(byDay(allVariants())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, Determinism, ::testing::ValuesIn(byNight(allVariants())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Every, EveryScene, ::testing::ValuesIn(allVariants()), VariantName());

}  // namespace
}  // namespace restlab::conformance
