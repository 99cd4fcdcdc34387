// Special behaviour of restir_gi in frames of a new view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/frame/session.h"
#include "tests/bias/test_cameras.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

constexpr uint32_t kFrames = 20;

SessionConfig movingConfig(const ParameterMap& parameters = {}) {
  SessionConfig config;
  config.integrator = "restir_gi";
  config.width = 40;
  config.height = 40;
  config.threads = 1;
  config.parameters = parameters;
  return config;
}

FrameStats lastFrame(Session& session, bool isMoving) {
  const SceneCamera end = makeBuiltinScene("cornell-box").cameras.at(0);
  const auto cameras = bias::walkTo(end, kFrames, {0.03, 0.01, 0.0}, 0.0);
  FrameStats stats;
  for (const SceneCamera& camera : cameras) {
    session.setCamera(isMoving ? camera : end);
    stats = session.frame();
  }
  return stats;
}

uint64_t spatialShiftRays(const FrameStats& stats) {
  for (const PassTiming& pass : stats.passes) {
    if (pass.name == "spatial_shift") return pass.raysPath;
  }
  return 0;
}

// Sums over seeds of each pixel's value, and of its square.
struct Sums {
  std::vector<double> first, second;
};
Sums firstFrames(const std::string& scene, const ParameterMap& parameters, uint32_t seeds) {
  Session session(bias::builtinScene(scene), movingConfig(parameters));
  Sums sums;
  for (uint32_t seed = 1; seed <= seeds; ++seed) {
    session.reset(seed);
    session.frame();
    const Image& image = session.radiance();
    sums.first.resize(image.pixels.size());
    sums.second.resize(image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const double value = double(image.pixels[i].y);
      sums.first[i] += value;
      sums.second[i] += value * value;
    }
  }
  return sums;
}

// The edge of the lamp causes most of the variance of a frame of the Cornell box. Eight film
// samples there must remove most of it and keep the mean of every pixel. In the courtyard the
// variance must not rise.
TEST(MovingView, TheEdgesOfLightsTakeSeveralFilmSamples) {
  constexpr uint32_t kSeeds = 256;
  const ParameterMap one = {
      {"temporal", false}, {"spatial_neighbours", int64_t{0}}, {"light_edge_samples", int64_t{0}}};
  ParameterMap eight = one;
  eight["light_edge_samples"] = int64_t{8};
  const std::pair<const char*, double> scenes[] = {{"cornell-box", 0.2}, {"courtyard", 1.01}};
  for (const auto& [scene, left] : scenes) {
    const Sums plain = firstFrames(scene, one, kSeeds), smooth = firstFrames(scene, eight, kSeeds);
    double variancePlain = 0.0, varianceSmooth = 0.0, worst = 0.0;
    for (size_t i = 0; i < plain.first.size(); ++i) {
      const auto varianceOf = [&](const Sums& s) {
        return (s.second[i] - s.first[i] * s.first[i] / kSeeds) / (kSeeds - 1);
      };
      const double v0 = varianceOf(plain), v1 = varianceOf(smooth);
      variancePlain += v0;
      varianceSmooth += v1;
      const double difference = (plain.first[i] - smooth.first[i]) / kSeeds;
      worst = std::max(worst, std::abs(difference) / std::sqrt((v0 + v1) / kSeeds + 1.0e-12));
    }
    EXPECT_LT(varianceSmooth, left * variancePlain) << scene;
    EXPECT_GT(varianceSmooth, 0.0) << scene;
    EXPECT_LT(worst, 5.5) << scene << ": standard errors, of 1600 pixels";
  }
}

// Images of lamps in metal spheres cause much of the variance of direct light in the gallery. How
// many samples they get depends on the last frame, which must leave the mean. The camera moves
// seven times before the frame that counts.
TEST(MovingView, ImagesOfLampsTakeSeveralFilmSamples) {
  constexpr size_t kSeeds = 96;
  const auto scene = bias::builtinScene("glossy-gallery");
  const auto cameras =
      bias::walkTo(makeBuiltinScene("glossy-gallery").cameras.at(0), 8, {0.02, 0.01, 0.0}, 0.0);
  double sums[2] = {}, squares[2] = {}, variance[2] = {};
  for (const size_t i : {0u, 1u}) {
    SessionConfig config = movingConfig({{"temporal", false},
                                         {"spatial_neighbours", int64_t{0}},
                                         {"light_edge_samples", int64_t(8 * i)}});
    config.width = 64;
    config.height = 36;
    config.components = rl::RL_COMPONENT_DIRECT;
    config.maxBounces = 1;
    Session session(scene, config);
    std::vector<double> first(size_t{64} * 36), second(first.size());
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
      session.reset(seed);
      for (const SceneCamera& camera : cameras) {
        session.setCamera(camera);
        session.frame();
      }
      double sum = 0.0;
      for (size_t pixel = 0; pixel < first.size(); ++pixel) {
        const double value = double(session.radiance().pixels[pixel].y);
        sum += value;
        first[pixel] += value;
        second[pixel] += value * value;
      }
      sums[i] += sum;
      squares[i] += sum * sum;
    }
    for (size_t pixel = 0; pixel < first.size(); ++pixel)
      variance[i] += (second[pixel] - first[pixel] * first[pixel] / kSeeds) / (kSeeds - 1);
    squares[i] = (squares[i] - sums[i] * sums[i] / kSeeds) / (kSeeds - 1);
  }
  EXPECT_LT(variance[1], 0.7 * variance[0]);
  EXPECT_GT(variance[1], 0.0);
  const double z = (sums[1] - sums[0]) / std::sqrt(kSeeds * (squares[0] + squares[1]));
  EXPECT_LT(std::abs(z), 4.0) << sums[0] / kSeeds << " and " << sums[1] / kSeeds;
}

TEST(MovingView, MovedHistoriesTakeTheDonorsOfYoungOnes) {
  const auto scene = bias::builtinScene("cornell-box");
  Session still(scene, movingConfig()), moving(scene, movingConfig());
  const uint64_t old = spatialShiftRays(lastFrame(still, false));
  EXPECT_GT(old, 0u);
  EXPECT_GT(spatialShiftRays(lastFrame(moving, true)), 2 * old);
}

TEST(MovingView, HasACapOfItsOwn) {
  const auto scene = bias::builtinScene("cornell-box");
  for (const bool isMoving : {false, true}) {
    Session small(scene, movingConfig({{"moving_confidence_cap", 2.0}}));
    Session large(scene, movingConfig({{"moving_confidence_cap", 20.0}}));
    lastFrame(small, isMoving);
    lastFrame(large, isMoving);
    EXPECT_EQ(countDifferent(small.radiance(), large.radiance()) > 0u, isMoving);
  }
}

}  // namespace
}  // namespace restlab::conformance
