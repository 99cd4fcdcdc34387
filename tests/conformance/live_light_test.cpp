// Lamps of a session are switched while its history goes on.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/frame/session.h"
#include "core/scene/compiled/light_factor.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

std::shared_ptr<const CompiledScene> lit(const std::string& scene, const std::string& light,
                                         double factor) {
  return CompiledScene::build(withLightFactor(makeBuiltinScene(scene), light, factor));
}

double energy(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels) sum += double(pixel.x + pixel.y + pixel.z);
  return sum;
}

SessionConfig lightConfig(const std::string& integrator) {
  SessionConfig config;
  config.integrator = integrator;
  config.width = 40;
  config.height = 24;
  config.threads = 1;
  return config;
}

struct Switch {
  const char* scene;
  const char* light;
};

// A method without a history renders nothing of the earlier scene.
TEST(LiveLight, PathRendersWhatAFreshSessionDoes) {
  for (const Switch& lamp :
       {Switch{"glossy-gallery", "light-large"}, Switch{"glossy-gallery", "all"},
        Switch{"courtyard", "sun"}, Switch{"courtyard", "environment"}}) {
    const auto on = bias::builtinScene(lamp.scene), off = lit(lamp.scene, lamp.light, 0.0);
    for (const char* rayTracing : {"embree", "bvh"}) {
      SessionConfig config = lightConfig("path");
      config.rayTracing = rayTracing;
      Session live(on, config), fresh(off, config);
      for (int i = 0; i < 3; ++i) live.frame();
      const Image before = live.radiance();
      live.setScene(off);
      live.frame();
      fresh.reset(config.seed, 3);
      fresh.frame();
      const std::string what = std::string(lamp.scene) + ", " + lamp.light + ", " + rayTracing;
      EXPECT_EQ(countDifferent(live.radiance(), fresh.radiance()), 0u) << what;
      EXPECT_LT(energy(live.radiance()), 0.97 * energy(before)) << what;
      live.setScene(on);
      live.frame();
      fresh.setScene(on);
      fresh.frame();
      EXPECT_EQ(countDifferent(live.radiance(), fresh.radiance()), 0u) << what << ", on again";
    }
  }
}

// Light is additive: one lamp, and all other lamps.
TEST(LiveLight, WhatALampGivesIsMissingWithoutIt) {
  SessionConfig config = lightConfig("path");
  config.maxBounces = 2;
  const auto meanOf = [&](const std::shared_ptr<const CompiledScene>& scene) {
    Session session(scene, config);
    double sum = 0.0;
    for (int i = 0; i < 64; ++i) {
      session.frame();
      sum += energy(session.radiance());
    }
    return sum;
  };
  Scene alone = withLightFactor(makeBuiltinScene("glossy-gallery"), "all", 0.0);
  alone = withLightFactor(std::move(alone), "light-large", 1.0);
  const double both = meanOf(bias::builtinScene("glossy-gallery"));
  const double without = meanOf(lit("glossy-gallery", "light-large", 0.0));
  const double lamp = meanOf(CompiledScene::build(std::move(alone)));
  EXPECT_NEAR((without + lamp) / both, 1.0, 0.02);
  EXPECT_GT(lamp, 0.2 * both);
}

class LiveLightOf : public ::testing::TestWithParam<Variant> {};

// A history is not told of the switch: with equal light in another scene object every bit stays the
// same, in a still view and in a moving one.
TEST_P(LiveLightOf, TheHistoryGoesOn) {
  const auto scene = bias::builtinScene("glossy-gallery");
  const auto same = lit("glossy-gallery", "all", 1.0);
  ASSERT_NE(same, scene);
  Session live(scene, configOf(GetParam())), kept(scene, configOf(GetParam()));
  SceneCamera camera = scene->source().cameras.at(0);
  for (int frame = 0; frame < 12; ++frame) {
    if (frame == 6 || frame == 10) live.setScene(frame == 6 ? same : scene);
    camera.cameraToWorld[3].x += frame < 9 ? 0.0 : 0.05;
    live.setCamera(camera);
    kept.setCamera(camera);
    live.frame();
    kept.frame();
    ASSERT_EQ(countDifferent(live.radiance(), kept.radiance()), 0u) << "frame " << frame;
  }
}

// All lights go off. Without a history the next frame is black; with one the old light fades.
TEST_P(LiveLightOf, LightThatWasFades) {
  const Variant& what = GetParam();
  Session session(bias::builtinScene("glossy-gallery"), configOf(what));
  for (int i = 0; i < 40; ++i) session.frame();
  const double before = energy(session.radiance());
  session.setScene(lit("glossy-gallery", "all", 0.0));
  session.frame();
  const double first = energy(session.radiance());
  if (!findMethod(session.config()).hasHistory(session.config().parameters)) {
    EXPECT_EQ(first, 0.0);
    return;
  }
  // Histories that retrace paths notice the change at once.
  const ParameterMap known = resolveParameters(findMethod(session.config()), {});
  if (const auto every = known.find("validate_every");
      every != known.end() && std::get<int64_t>(every->second) != 0) {
    EXPECT_LT(first, 0.5 * before);
    return;
  }
  // Cells of radiance hold only a part of the indirect light and notice the change one after
  // another.
  EXPECT_GT(first, (what.endsPaths ? 0.02 : 0.5) * before);
  EXPECT_LT(first, before);
  for (int i = 0; i < 80; ++i) session.frame();
  EXPECT_LT(energy(session.radiance()), 0.5 * first);
}

INSTANTIATE_TEST_SUITE_P(All, LiveLightOf, ::testing::ValuesIn(byDay(allVariants())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, LiveLightOf, ::testing::ValuesIn(byNight(allVariants())),
                         VariantName());

TEST(LiveLight, AnotherSceneIsRefused) {
  Session session(bias::builtinScene("cornell-box"), lightConfig("restir_gi"));
  Session kept(bias::builtinScene("cornell-box"), lightConfig("restir_gi"));
  session.frame();
  kept.frame();
  EXPECT_THROW(session.setScene(bias::builtinScene("door-ajar")), Error);
  session.frame();
  kept.frame();
  EXPECT_EQ(countDifferent(session.radiance(), kept.radiance()), 0u);
}

}  // namespace
}  // namespace restlab::conformance
