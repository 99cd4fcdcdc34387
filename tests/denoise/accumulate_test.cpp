// Exponential average of frames, as sessions show it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "core/scene/camera_path/camera_path.h"
#include "tests/conformance/variants.h"

namespace restlab {
namespace {

using bias::builtinScene;
using conformance::countDifferent;

SessionConfig configWith(const std::string& denoiser, const ParameterMap& parameters = {}) {
  SessionConfig config;
  config.denoiser = denoiser;
  config.parameters = parameters;
  config.width = 48;
  config.height = 27;
  config.threads = 1;
  return config;
}

CameraMotion motionOf(const CompiledScene& scene, const CameraPath& path) {
  return resolveCameraPath(path, scene.source(), 0);
}

double largestRelative(const Image& image, const std::vector<glm::dvec3>& truth) {
  double largest = 0.0;
  for (size_t p = 0; p < truth.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(double(image.pixels[p][c]) - truth[p][c]);
      largest = std::max(largest, difference / (std::abs(truth[p][c]) + 1e-3));
    }
  }
  return largest;
}

// Frame n has weight 1 / min(n, cap + 1), the earlier average the rest: computed here in double
// precision from the frames themselves. For restir_gi, whose radiance averages 21 frames, n counts
// from frame 21 on.
class AnalyticWeights : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(AnalyticWeights, AreThoseOfAStillView) {
  const auto& [integrator, cap] = GetParam();
  const double held = std::string(integrator) == "restir_gi" ? 20.0 : 0.0;
  const auto scene = builtinScene("cornell-box");
  SessionConfig without = configWith("none");
  SessionConfig with = configWith("accumulate", {{"accumulate_cap", cap}});
  without.integrator = with.integrator = integrator;
  Session plain(scene, without), average(scene, with);
  std::vector<glm::dvec3> expected(plain.radiance().pixels.size(), glm::dvec3(0.0));
  for (uint32_t frame = 0; frame < 30; ++frame) {
    plain.frame();
    average.frame();
    const double n = std::min(double(frame), cap + held) + 1.0 - held;
    const double weight = 1.0 / std::max(n, 1.0);
    for (size_t p = 0; p < expected.size(); ++p)
      expected[p] += weight * (glm::dvec3(plain.radiance().pixels[p]) - expected[p]);
    ASSERT_LT(largestRelative(average.radiance(), expected), 1e-5) << "frame " << frame;
  }
  EXPECT_EQ(countDifferent(plain.radiance(), average.radiance()) == 0, cap == 0.0);
}

INSTANTIATE_TEST_SUITE_P(Caps, AnalyticWeights,
                         ::testing::Combine(::testing::Values("path", "restir_gi"),
                                            ::testing::Values(0.0, 3.0, 20.0, 1e6)));

TEST(Accumulate, BeginsAnewAfterAResetAndACut) {
  const auto scene = builtinScene("door-ajar");
  Session plain(scene, configWith("none")), average(scene, configWith("accumulate"));
  CameraPath path;
  path.kind = CameraPathKind::back;
  path.cutFrame = 5;
  path.cutDegrees = 180.0;
  const CameraMotion motion = motionOf(*scene, path);
  for (const uint32_t seed : {1u, 2u}) {
    plain.reset(seed);
    average.reset(seed);
    for (uint32_t frame = 0; frame < 7; ++frame) {
      for (Session* session : {&plain, &average}) {
        session->setCamera(cameraAt(motion, frame));
        session->frame();
      }
      const bool isFresh = frame == 0 || frame == path.cutFrame;
      EXPECT_EQ(countDifferent(plain.radiance(), average.radiance()) == 0, isFresh)
          << "seed " << seed << ", frame " << frame;
    }
  }
}

// Every point of the room emits alike: the source of a history does not matter.
TEST(Accumulate, LeavesAConstantAsItIs) {
  const auto scene = builtinScene("furnace");
  for (const char* filter : {"nearest", "bilinear"}) {
    SessionConfig config = configWith("accumulate", {{"accumulate_filter", std::string(filter)}});
    config.maxBounces = 0;
    Session session(scene, config);
    session.frame();
    CameraPath path;
    path.kind = CameraPathKind::pan;
    path.degreesPerFrame = 0.7;
    const CameraMotion motion = motionOf(*scene, path);
    const glm::vec3 constant = session.radiance().pixels.front();
    for (uint32_t frame = 1; frame < 12; ++frame) {
      session.setCamera(cameraAt(motion, frame));
      session.frame();
      for (const glm::vec3& pixel : session.radiance().pixels) {
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(pixel[c], constant[c], 1e-5f * constant[c]) << filter << ", frame " << frame;
      }
    }
  }
}

// The history is found after a turn there and back, and followed while the camera turns.
TEST(Accumulate, FollowsSurfacesThroughAPan) {
  const auto scene = builtinScene("door-ajar");
  CameraPath path;
  path.kind = CameraPathKind::pan;
  path.degreesPerFrame = 0.5;
  const CameraMotion motion = motionOf(*scene, path);
  constexpr uint32_t kFrames = 17;
  SessionConfig config = configWith("none");
  config.seed = 99;
  Session truth(scene, config);
  truth.setCamera(cameraAt(motion, kFrames - 1));
  std::vector<glm::dvec3> sum(truth.radiance().pixels.size(), glm::dvec3(0.0));
  for (int i = 0; i < 512; ++i) {
    truth.frame();
    for (size_t p = 0; p < sum.size(); ++p) sum[p] += glm::dvec3(truth.radiance().pixels[p]);
  }
  Image reference(config.width, config.height);
  for (size_t p = 0; p < sum.size(); ++p) reference.pixels[p] = glm::vec3(sum[p] / 512.0);
  const auto errorOf = [&](const SessionConfig& of) {
    Session session(scene, of);
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
      session.setCamera(cameraAt(motion, frame));
      session.frame();
    }
    return evaluateMetric("mse", session.radiance(), reference).value;
  };
  const double plain = errorOf(configWith("none"));
  for (const char* filter : {"nearest", "bilinear"}) {
    const double average =
        errorOf(configWith("accumulate", {{"accumulate_filter", std::string(filter)}}));
    EXPECT_LT(average, plain / 2.0) << filter;
  }
  // With a test that always fails, every frame begins a history.
  const double never = errorOf(configWith(
      "accumulate", {{"accumulate_plane_threshold", 0.0}, {"accumulate_normal_threshold", 1.0}}));
  EXPECT_GT(never, plain / 2.0);
}

TEST(Accumulate, CostsARayOnlyInFramesOfANewView) {
  const auto scene = builtinScene("cornell-box");
  Session session(scene, configWith("accumulate"));
  const uint64_t pixels = uint64_t(session.config().width) * session.config().height;
  const auto raysOf = [](const FrameStats& stats) { return stats.passes.at(0).raysPath; };
  EXPECT_EQ(session.frame().passes.at(0).name, "gbuffer");
  EXPECT_EQ(raysOf(session.frame()), 0u);
  CameraPath path;
  path.kind = CameraPathKind::pan;
  path.degreesPerFrame = 0.5;
  session.setCamera(cameraAt(motionOf(*scene, path), 1));
  EXPECT_EQ(raysOf(session.frame()), pixels);
  EXPECT_EQ(raysOf(session.frame()), 0u);
}

TEST(Accumulate, IsRefusedWhatItCannotUse) {
  const auto scene = builtinScene("cornell-box");
  const auto refuses = [&](const SessionConfig& config, const std::string& part) {
    try {
      Session session(scene, config);
      ADD_FAILURE() << "accepted; expected: " << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refuses(configWith("acumulate"), "'accumulate'");
  refuses(configWith("accumulate", {{"accumulate_cap", -1.0}}), "between 0");
  refuses(configWith("accumulate", {{"accumulate_filter", std::string("linear")}}), "bilinear");
  refuses(configWith("accumulate", {{"acumulate_cap", 1.0}}), "'accumulate_cap'");
  refuses(configWith("none", {{"accumulate_cap", 1.0}}), "accumulate_cap");
  SessionConfig cached = configWith("accumulate");
  cached.cache = "pixel";
  refuses(cached, "no use");
}

}  // namespace
}  // namespace restlab
