// Paths that end in cells of radiance, compared with path's own: the energy is kept, the error of
// the mean is small compared with that of a frame, and rays are saved.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/compiled/light_factor.h"
#include "tests/bias/few_entries.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

constexpr uint32_t kWarmUp = 64;

SessionConfig boxConfig(const char* secondary) {
  SessionConfig config;
  config.width = config.height = 48;
  config.threads = 1;
  config.parameters["secondary"] = std::string(secondary);
  bias::useFewEntries(config);
  return config;
}

struct Measured {
  glm::dvec3 mean{0.0};
  std::vector<glm::dvec3> pixels;
  std::vector<double> variances;  // per frame, summed over channels
  double rays = 0.0;              // per frame
};

Measured measure(Session& session, uint32_t frames) {
  Measured m;
  for (uint32_t i = 0; i < frames; ++i) {
    const FrameStats stats = session.frame();
    m.rays += double(stats.raysPath + stats.raysShadow) / frames;
    const Image& image = session.radiance();
    m.pixels.resize(image.pixels.size());
    m.variances.resize(image.pixels.size());
    for (size_t p = 0; p < m.pixels.size(); ++p) {
      const glm::dvec3 pixel(image.pixels[p]);
      m.pixels[p] += pixel / double(frames);
      m.variances[p] += glm::dot(pixel, pixel) / double(frames);
    }
  }
  for (size_t p = 0; p < m.pixels.size(); ++p) m.variances[p] -= glm::dot(m.pixels[p], m.pixels[p]);
  for (const glm::dvec3& p : m.pixels) m.mean += p / double(m.pixels.size());
  return m;
}

TEST(Radiance, PathsThatEndKeepTheEnergyAndSaveRays) {
  for (const char* name : {"cornell-box", "door-ajar", "glossy-gallery"}) {
    SCOPED_TRACE(name);
    const auto scene = bias::builtinScene(name);
    Session whole(scene, boxConfig("trace")), ending(scene, boxConfig("cache"));
    ending.frames(kWarmUp);
    const Measured a = measure(whole, 192), b = measure(ending, 192);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b.mean[c] / a.mean[c], 1.0, 0.06) << c;
    // Each mean has 1/192 of a frame's error; any further difference between them is bias.
    double difference = 0.0, error = 0.0;
    for (size_t p = 0; p < a.pixels.size(); ++p) {
      difference += glm::dot(b.pixels[p] - a.pixels[p], b.pixels[p] - a.pixels[p]);
      error += a.variances[p];
    }
    EXPECT_LT(difference, 0.05 * error);
    EXPECT_LT(b.rays, 0.7 * a.rays);
  }
}

TEST(Radiance, ANewHistoryTracesItsPathsToTheirEnds) {
  const auto scene = bias::builtinScene("cornell-box");
  Session whole(scene, boxConfig("trace")), ending(scene, boxConfig("cache"));
  whole.frame();
  ending.frame();
  EXPECT_EQ(countDifferent(whole.radiance(), ending.radiance()), 0u);
  ending.frames(16);
  ending.reset(ending.config().seed);
  ending.frame();
  EXPECT_EQ(countDifferent(whole.radiance(), ending.radiance()), 0u) << "cells outlive a history";
}

TEST(Radiance, WhatHasNoPlaceIsCountedAndTraced) {
  SessionConfig config = boxConfig("cache");
  config.parameters["radiance_entries"] = int64_t{1024};
  config.parameters["radiance_pixels"] = 1.0;
  config.parameters["radiance_every"] = int64_t{1};
  Session session(bias::builtinScene("door-ajar"), config);
  uint64_t full = 0;
  for (int i = 0; i < 32; ++i) {
    const FrameStats stats = session.frame();
    full += stats.health.counts[rl::RL_HEALTH_CACHE_FULL];
    EXPECT_EQ(stats.health.counts[rl::RL_HEALTH_NONFINITE], 0u);
  }
  EXPECT_GT(full, 1000u);
  SessionConfig trace = config;
  trace.parameters = {};
  Session whole(bias::builtinScene("door-ajar"), trace);
  const Measured a = measure(whole, 128), b = measure(session, 128);
  EXPECT_NEAR(b.mean.y / a.mean.y, 1.0, 0.08);
}

// A constant light must never count as changed, whatever the camera does; a changed light must be
// noticed.
TEST(Radiance, CellsForgetLightThatChanged) {
  const auto bright = bias::builtinScene("door-ajar");
  const auto dim =
      CompiledScene::build(withLightFactor(makeBuiltinScene("door-ajar"), kAllLights, 0.25));
  const auto energyAfter = [&](int64_t validateEvery) {
    SessionConfig config = boxConfig("cache");
    config.parameters["radiance_validate"] = validateEvery;
    Session session(bright, config);
    const SceneCamera start = bright->source().cameras.front();
    for (int i = 0; i < 96; ++i) {
      SceneCamera camera = start;
      if (i >= 32 && i < 64) camera.cameraToWorld[3] += 0.01 * (i - 31) * start.cameraToWorld[0];
      session.setCamera(camera);
      const FrameStats stats = session.frame();
      EXPECT_EQ(stats.health.counts[rl::RL_HEALTH_LIGHT_CHANGED], 0u) << "frame " << i;
    }
    session.setScene(dim);
    uint64_t changed = 0;
    for (int i = 0; i < 16; ++i)
      changed += session.frame().health.counts[rl::RL_HEALTH_LIGHT_CHANGED];
    if (validateEvery < 16) {
      EXPECT_GT(changed, 50u);
    }
    return measure(session, 32).mean.y;
  };
  Session truth(dim, boxConfig("trace"));
  const double right = measure(truth, 192).mean.y;
  EXPECT_NEAR(energyAfter(4) / right, 1.0, 0.15);
  EXPECT_GT(energyAfter(1 << 20) / right, 1.3) << "the check sees what is remembered";
}

// One lamp of several, which only some paths carry, goes off and on again.
TEST(Radiance, OneLampOfSeveralIsNoticed) {
  SessionConfig config = boxConfig("cache");
  config.parameters["radiance_validate"] = int64_t{4};
  const auto lit = bias::builtinScene("glossy-gallery");
  const auto partly =
      CompiledScene::build(withLightFactor(makeBuiltinScene("glossy-gallery"), "light-large", 0.0));
  Session session(lit, config);
  session.frames(96);
  for (const auto& scene : {partly, lit}) {
    session.setScene(scene);
    session.frames(48);
    Session truth(scene, boxConfig("trace"));
    EXPECT_NEAR(measure(session, 96).mean.y / measure(truth, 192).mean.y, 1.0, 0.1);
  }
}

TEST(Radiance, NothingIsKeptWherePathsAreTraced) {
  const auto scene = bias::builtinScene("cornell-box");
  Session whole(scene, boxConfig("trace")), ending(scene, boxConfig("cache"));
  EXPECT_EQ(whole.bytesPerPixel(), 12u);
  EXPECT_GT(ending.bytesPerPixel(), 12u);
  EXPECT_NO_THROW(whole.reset(1, 5));
  EXPECT_THROW(ending.reset(1, 5), Error);
}

}  // namespace
}  // namespace restlab::conformance
