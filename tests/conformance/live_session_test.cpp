// Changes to a running session, as an interactive program makes them.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/frame/session.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

SessionConfig sessionConfig() {
  SessionConfig config;
  config.integrator = "restir_gi";
  config.width = 40;
  config.height = 24;
  config.threads = 1;
  return config;
}

std::string valueOf(const Session& session, const std::string& name) {
  for (const ProbeValue& v : session.probe(20, 18)) {
    if (v.name == name) return v.value;
  }
  return "";
}
double numberOf(const Session& session, const std::string& name) {
  return std::stod(valueOf(session, name));
}

Image shown(Session& session, uint32_t frames) {
  for (uint32_t i = 0; i < frames; ++i) session.frame();
  return session.radiance();
}

// A parameter that changes no buffer keeps the history; frames use the new value from then on.
TEST(LiveSession, ParametersChangeWithoutANewHistory) {
  const auto scene = bias::builtinScene("door-ajar");
  SessionConfig config = sessionConfig();
  config.parameters["confidence_cap"] = 5.0;
  Session changed(scene, config), kept(scene, config);
  EXPECT_EQ(countDifferent(shown(changed, 6), shown(kept, 6)), 0u);
  EXPECT_FALSE(changed.setParameters({{"confidence_cap", 40.0}}));
  EXPECT_EQ(std::get<double>(changed.config().parameters.at("confidence_cap")), 40.0);
  const Image after = shown(changed, 3), before = shown(kept, 3);
  EXPECT_GT(countDifferent(after, before), 0u);
  // `after` is the ninth frame of a history, not the third.
  config.parameters["confidence_cap"] = 40.0;
  Session fresh(scene, config);
  EXPECT_GT(countDifferent(after, shown(fresh, 3)), 0u);
  EXPECT_GT(numberOf(changed, "confidence"), numberOf(fresh, "confidence"));
}

// The cache reads surfaces only in frames of a new view, and new parameters begin one: with
// thresholds that accept everything there are no outlines left.
TEST(LiveSession, ParametersOfTheCacheReachAStillView) {
  const auto scene = bias::builtinScene("cornell-box");
  const ParameterMap open = {{"normal_threshold", -1.0}, {"plane_threshold", 10.0}};
  SessionConfig config = sessionConfig();
  Session changed(scene, config);
  config.parameters = open;
  Session fresh(scene, config);
  // Sums the rays of the pass `spatial_shift` in 16 frames of an old history.
  const auto rays = [](Session& session) {
    double sum = 0.0;
    for (uint32_t frame = 0; frame < 16; ++frame) {
      for (const PassTiming& pass : session.frame().passes)
        sum += pass.name == "spatial_shift" ? double(pass.raysPath) : 0.0;
    }
    return sum;
  };
  shown(changed, 30);
  shown(fresh, 30);
  const double before = rays(changed), wanted = rays(fresh);
  EXPECT_LT(before, 0.9 * wanted);
  changed.setParameters(open);
  shown(changed, 30);
  EXPECT_NEAR(rays(changed) / wanted, 1.0, 0.05);
}

// The first frame of a history has nothing to reuse over time.
TEST(LiveSession, TheFirstFrameIsReuseOverSpaceAlone) {
  const auto scene = bias::builtinScene("door-ajar");
  SessionConfig config = sessionConfig();
  Session both(scene, config);
  config.parameters["temporal"] = false;
  Session space(scene, config);
  EXPECT_EQ(countDifferent(shown(both, 1), shown(space, 1)), 0u);
  EXPECT_GT(countDifferent(shown(both, 1), shown(space, 1)), 0u);
}

// The limit decides which light the reservoirs hold: reservoirs of another limit would be wrong.
// Setting a parameter to its current value changes nothing.
TEST(LiveSession, AnotherSplitOfLightBeginsANewHistory) {
  const auto scene = bias::builtinScene("glossy-gallery");
  SessionConfig config = sessionConfig();
  Session changed(scene, config), kept(scene, config);
  EXPECT_EQ(countDifferent(shown(changed, 3), shown(kept, 3)), 0u);
  EXPECT_FALSE(changed.setParameters({{"roughness_limit", 0.2}}));
  EXPECT_EQ(countDifferent(shown(changed, 2), shown(kept, 2)), 0u);
  EXPECT_TRUE(changed.setParameters({{"roughness_limit", 0.05}}));
  config.parameters["roughness_limit"] = 0.05;
  Session fresh(scene, config);
  EXPECT_EQ(countDifferent(shown(changed, 2), shown(fresh, 2)), 0u);
}

TEST(LiveSession, AnUnknownParameterChangesNothing) {
  const auto scene = bias::builtinScene("cornell-box");
  Session changed(scene, sessionConfig()), kept(scene, sessionConfig());
  EXPECT_THROW(changed.setParameters({{"confidence_cap", 7.0}, {"spatial_radus", 3.0}}), Error);
  EXPECT_THROW(changed.setParameters({{"confidence_cap", -1.0}}), Error);
  EXPECT_EQ(countDifferent(shown(changed, 4), shown(kept, 4)), 0u);
}

// A parameter that changes buffers acts like a new session.
TEST(LiveSession, OtherBuffersStartANewHistory) {
  const auto scene = bias::builtinScene("cornell-box");
  Session changed(scene, sessionConfig());
  shown(changed, 3);
  EXPECT_TRUE(changed.setParameters({{"spatial_neighbours", int64_t{2}}}));
  SessionConfig config = sessionConfig();
  config.parameters["spatial_neighbours"] = int64_t{2};
  Session fresh(scene, config);
  EXPECT_EQ(countDifferent(shown(changed, 4), shown(fresh, 4)), 0u);
}

TEST(LiveSession, AResizedImageIsThatOfAFreshSession) {
  const auto scene = bias::builtinScene("glossy-gallery");
  Session changed(scene, sessionConfig());
  shown(changed, 3);
  changed.resize(64, 36);
  SessionConfig config = sessionConfig();
  config.width = 64;
  config.height = 36;
  Session fresh(scene, config);
  EXPECT_EQ(countDifferent(shown(changed, 4), shown(fresh, 4)), 0u);
  EXPECT_EQ(countDifferent(changed.aov("normalW"), fresh.aov("normalW")), 0u);
  EXPECT_THROW(changed.resize(0, 36), Error);
}

// Layers belong to a frame: after a resize or a new history there are none.
TEST(LiveSession, LayersNeedAFrame) {
  const auto scene = bias::builtinScene("cornell-box");
  Session session(scene, sessionConfig());
  EXPECT_THROW(session.aov("depth"), Error);
  session.frame();
  EXPECT_EQ(session.aov("depth").width, 40u);
  session.resize(16, 8);
  EXPECT_THROW(session.aov("depth"), Error);
  session.frame();
  EXPECT_EQ(session.aov("depth").width, 16u);
  EXPECT_GT(session.aov("depth").pixels[4 * 16 + 8].x, 0.0f);
  session.reset(3);
  EXPECT_THROW(session.aov("depth"), Error);
}

// Layers belong to the last frame, in any order of requests.
TEST(LiveSession, LayersAreTracedOnceAFrame) {
  const auto scene = bias::builtinScene("cornell-box");
  Session one(scene, sessionConfig()), other(scene, sessionConfig());
  one.frame();
  other.frame();
  const Image normal = one.aov("normalW"), depth = one.aov("depth");
  EXPECT_EQ(countDifferent(depth, other.aov("depth")), 0u);
  EXPECT_EQ(countDifferent(normal, other.aov("normalW")), 0u);
  one.frame();
  EXPECT_GT(countDifferent(one.aov("depth"), depth), 0u);  // the film samples differ
}

TEST(LiveSession, AProbeShowsTheReservoir) {
  const auto scene = bias::builtinScene("cornell-box");
  Session session(scene, sessionConfig());
  for (int i = 0; i < 5; ++i) session.frame();
  EXPECT_GE(numberOf(session, "confidence"), 5.0);
  EXPECT_GT(numberOf(session, "W"), 0.0);
  EXPECT_NE(valueOf(session, "kind"), "");
  EXPECT_THROW(session.probe(40, 0), Error);
  SessionConfig plain = sessionConfig();
  plain.integrator = "path";
  EXPECT_TRUE(Session(scene, plain).probe(0, 0).empty());
}

}  // namespace
}  // namespace restlab::conformance
