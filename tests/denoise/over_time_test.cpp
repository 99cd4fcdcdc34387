// Denoisers with a history from frame to frame: errors fall while nothing changes, and old images
// disappear after a cut or a switch.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/image/metrics/metrics.h"
#include "core/scene/camera_path/camera_path.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/compiled/light_factor.h"
#include "tests/conformance/variants.h"
#include "tests/denoise/layered_images.h"

namespace restlab::denoise {
namespace {

constexpr glm::uvec2 kSize = {64, 36};

Image add(const Image& a, const Image& b, double share) {
  Image sum = a;
  for (size_t p = 0; p < sum.pixels.size(); ++p)
    sum.pixels[p] += (b.pixels[p] - sum.pixels[p]) * float(share);
  return sum;
}

// Returns the mean of `frames` frames of path tracing.
Image meanOfFrames(const std::shared_ptr<const CompiledScene>& scene, uint32_t frames,
                   uint32_t seed, const std::optional<SceneCamera>& camera = {},
                   glm::uvec2 size = kSize) {
  SessionConfig config = filterConfig("none", size);
  config.seed = seed;
  Session session(scene, config);
  if (camera) session.setCamera(*camera);
  Image mean(size.x, size.y);
  for (uint32_t i = 0; i < frames; ++i) {
    session.frame();
    mean = add(mean, session.radiance(), 1.0 / (i + 1.0));
  }
  return mean;
}

struct Method {
  const char* integrator;
  const char* denoiser;
  double floor;    // limit of the final MSE over that of one path-traced frame
  int framesDark;  // most frames until a switch has faded to a tenth
};
std::string nameOf(const testing::TestParamInfo<Method>& info) {
  return std::string(info.param.integrator) + "_" + info.param.denoiser;
}
SessionConfig configOf(const Method& method) {
  SessionConfig config = filterConfig(method.denoiser, kSize);
  config.integrator = method.integrator;
  return config;
}

class OverTime : public testing::TestWithParam<Method> {};

// Errors fall to a floor: the blur of the filter.
TEST_P(OverTime, ErrorsFallInAStillView) {
  const auto scene = bias::builtinScene("door-ajar");
  // Shared by all methods.
  static const Image half0 = meanOfFrames(scene, 512, 7001), half1 = meanOfFrames(scene, 512, 7002);
  constexpr uint32_t kRuns = 4;
  std::map<uint32_t, double> errors;  // by frames in the history
  double plain = 0.0;
  Session session(scene, configOf(GetParam())), path(scene, filterConfig("none", kSize));
  for (uint32_t run = 0; run < kRuns; ++run) {
    session.reset(run + 1);
    path.reset(run + 1);
    path.frame();
    plain += mseAgainstHalves(path.radiance(), half0, half1) / kRuns;
    for (uint32_t frame = 1; frame <= 64; ++frame) {
      session.frame();
      if (frame == 1 || frame == 4 || frame == 16 || frame == 64)
        errors[frame] += mseAgainstHalves(session.radiance(), half0, half1) / kRuns;
    }
  }
  std::printf("MSE over a frame of path: %.4f %.4f %.4f %.4f at frames 1, 4, 16, 64\n",
              errors[1] / plain, errors[4] / plain, errors[16] / plain, errors[64] / plain);
  EXPECT_LT(errors[16], 0.8 * errors[1]);
  EXPECT_LT(errors[64], 0.8 * errors[16]);
  EXPECT_LT(errors[64], GetParam().floor * plain);
}

// Returns how much of the earlier image remains: 1 all of it, 0 nothing.
double ghost(const Image& shown, const Image& before, const Image& now) {
  double sum = 0.0, all = 0.0;
  for (size_t p = 0; p < shown.pixels.size(); ++p) {
    const glm::dvec3 step = glm::dvec3(before.pixels[p]) - glm::dvec3(now.pixels[p]);
    sum += glm::dot(glm::dvec3(shown.pixels[p]) - glm::dvec3(now.pixels[p]), step);
    all += glm::dot(step, step);
  }
  return sum / all;
}

TEST_P(OverTime, ALampThatIsSwitchedIsForgotten) {
  const auto bright = bias::builtinScene("cornell-box");
  const auto dim =
      CompiledScene::build(withLightFactor(makeBuiltinScene("cornell-box"), kAllLights, 0.25));
  const Image before = meanOfFrames(bright, 256, 7001), now = meanOfFrames(dim, 256, 7002);
  Session session(bright, configOf(GetParam()));
  constexpr int kRuns = 3, kMost = 80;
  std::vector<double> ghosts(kMost);
  for (int run = 0; run < kRuns; ++run) {
    session.reset(uint32_t(run) + 1);
    session.setScene(bright);
    session.frames(32);
    EXPECT_GT(ghost(session.radiance(), before, now), 0.9);
    session.setScene(dim);
    for (double& sum : ghosts) {
      session.frame();
      sum += ghost(session.radiance(), before, now) / kRuns;
    }
  }
  int frames = 1;
  while (frames < kMost && ghosts[size_t(frames) - 1] > 0.1) ++frames;
  std::printf("a lamp that is switched: a tenth is left after %d frames\n", frames);
  EXPECT_LE(frames, GetParam().framesDark);
  EXPECT_LE(ghosts.back(), 0.1);
}

// Everything in view is new, and the health count says so: the earlier image changes no bit.
TEST_P(OverTime, ACutIsForgottenAtOnce) {
  const auto scene = bias::builtinScene("door-ajar");
  Session session(scene, configOf(GetParam()));
  FrameStats stats;
  const auto after = [&](double degrees) {
    CameraPath path;
    path.kind = CameraPathKind::back;
    path.leaveFrame = 0;
    path.cutFrame = 12;
    path.cutDegrees = degrees;
    const CameraMotion motion = resolveCameraPath(path, scene->source(), 0);
    session.reset(1);
    for (uint32_t frame = 0; frame <= 12; ++frame) {
      session.setCamera(cameraAt(motion, frame));
      stats = session.frame();
    }
    return session.radiance();
  };
  const Image a = after(180.0), b = after(130.0);
  EXPECT_EQ(conformance::countDifferent(a, b), 0u);
  EXPECT_EQ(stats.health.counts[rl::RL_HEALTH_NEW_HISTORY], kSize.x * kSize.y);
}

// Returns the MSE of the last of `frames` frames of an orbiting camera, averaged over `runs`.
double errorOfOrbit(const char* name, const SessionConfig& config, uint32_t frames, uint32_t runs) {
  const auto scene = bias::builtinScene(name);
  CameraPath path;
  path.kind = CameraPathKind::orbit;
  path.degreesPerFrame = -0.25;
  const CameraMotion motion = resolveCameraPath(path, scene->source(), 0);
  // One reference per scene.
  static std::map<std::string, std::array<Image, 2>> references;
  auto [halves, isNew] = references.try_emplace(name);
  for (uint32_t half = 0; isNew && half < 2; ++half)
    halves->second[half] = meanOfFrames(scene, 256, 7001 + half, cameraAt(motion, frames - 1),
                                        {config.width, config.height});
  Session session(scene, config);
  double error = 0.0;
  for (uint32_t run = 0; run < runs; ++run) {
    session.reset(run + 1);
    for (uint32_t frame = 0; frame < frames; ++frame) {
      session.setCamera(cameraAt(motion, frame));
      session.frame();
    }
    error += mseAgainstHalves(session.radiance(), halves->second[0], halves->second[1]) / runs;
  }
  return error;
}

// Requires that a parameter lowers that error below `share` of the error without it.
void expectLower(const char* scene, glm::uvec2 size, const char* parameter, uint32_t frames,
                 uint32_t runs, double share) {
  SessionConfig config = filterConfig("svgf", size);
  const double with = errorOfOrbit(scene, config, frames, runs);
  config.parameters[parameter] = 0.0;
  const double without = errorOfOrbit(scene, config, frames, runs);
  std::printf("MSE %.5f, without %s %.5f\n", with, parameter, without);
  EXPECT_LT(with, share * without);
}

// In each frame the film sample of an edge pixel lies on the bright or on the dark side.
TEST(MovingView, EdgesAreAveraged) { expectLower("door-ajar", kSize, "svgf_resolve", 24, 4, 0.75); }
// At half the image size the lamp's edge dominates the error.
TEST(MovingView, NightlyGlossIsForgotten) {
  expectLower("glossy-gallery", {128, 72}, "svgf_turn", 36, 3, 0.85);
}

// The filter reads reservoirs that other threads write.
TEST(MovingView, ThreadsChangeNoBit) {
  const auto scene = bias::builtinScene("glossy-gallery");
  SessionConfig config = filterConfig("svgf_restir", kSize);
  config.integrator = "restir_gi";
  Session one(scene, config);
  config.threads = 5;
  Session many(scene, config);
  conformance::runFrames(one, *scene, 14);
  conformance::runFrames(many, *scene, 14);
  EXPECT_EQ(conformance::countDifferent(one.radiance(), many.radiance()), 0u);
}

// Layers of a session's frames with a moving camera, filtered as an image sequence, give the
// session's result except at edges: a layer describes a surface less well than its guide.
TEST(Motion, IsALayerThatSequencesFollow) {
  const auto scene = bias::builtinScene("door-ajar");
  CameraPath path;
  path.kind = CameraPathKind::orbit;
  path.degreesPerFrame = -0.5;
  const CameraMotion motion = resolveCameraPath(path, scene->source(), 0);
  SessionConfig config = filterConfig("none", kSize);
  Session session(scene, config);
  config = filterConfig("svgf", kSize);
  config.parameters["svgf_iterations"] = int64_t{0};
  ImageDenoiser following(config), blind(config);
  Image shown, without;
  for (uint32_t frame = 0; frame < 24; ++frame) {
    session.setCamera(cameraAt(motion, frame));
    session.frame();
    LayeredFrame layers;
    layers.radiance = session.radiance();
    layers.normalW = session.aov("normalW");
    layers.depthMetres = session.aov("depth");
    layers.albedo = session.aov("albedo");
    layers.lights = session.aov("emission");
    without = blind.frame(layers);
    layers.motion = session.aov("motion");
    shown = following.frame(layers);
  }
  const SceneCamera last = cameraAt(motion, 23);
  const Image half0 = meanOfFrames(scene, 256, 7001, last);
  const Image half1 = meanOfFrames(scene, 256, 7002, last);
  const double plain = mseAgainstHalves(session.radiance(), half0, half1);
  const double followed = mseAgainstHalves(shown, half0, half1);
  const double blurred = mseAgainstHalves(without, half0, half1);
  std::printf("MSE over that of the frame: %.4f with motion, %.4f without\n", followed / plain,
              blurred / plain);
  EXPECT_LT(followed, 0.2 * plain);
  EXPECT_LT(followed, 0.7 * blurred);
}

// In a still view the previous depth equals the current one, with parallel rays, too.
TEST(Motion, HasTheDepthOfOrthographicCameras) {
  const auto scene = bias::builtinScene("cornell-box");
  SceneCamera camera = scene->source().cameras.at(0);
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = 0.4;
  Session session(scene, filterConfig("none", kSize));
  session.setCamera(camera);
  for (int i = 0; i < 2; ++i) session.frame();
  const Image depth = session.aov("depth"), motion = session.aov("motion");
  for (size_t p = 0; p < depth.pixels.size(); ++p)
    EXPECT_NEAR(motion.pixels[p].z, depth.pixels[p].x, 1e-4f * depth.pixels[p].x) << p;
}

INSTANTIATE_TEST_SUITE_P(, OverTime,
                         testing::Values(Method{"path", "accumulate", 0.035, 60},
                                         Method{"restir_gi", "svgf_restir", 0.009, 79}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Nightly, OverTime,
                         testing::Values(Method{"path", "svgf", 0.009, 60},
                                         Method{"path", "asvgf", 0.009, 5}),
                         nameOf);

}  // namespace
}  // namespace restlab::denoise
