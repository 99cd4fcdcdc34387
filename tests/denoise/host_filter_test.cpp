// Denoisers that run on the host (core/frame/host_filter.h), tested by one that is registered for
// the duration of a test.
#include <gtest/gtest.h>

#include <cmath>

#include "core/backend/backend.h"
#include "core/frame/method.h"
#include "denoise/common/settings.h"
#include "tests/bias/independent_runs.h"
#include "tests/denoise/layered_images.h"

namespace restlab::denoise {
namespace {

// Shows the radiance times "dimmed_factor" and stores its inputs.
class HostFilters : public testing::Test {
 protected:
  HostFilters() : before_(denoiserRegistry()) {
    info_.name = "dimmed";
    info_.needsFeatures = true;
    info_.parameters = {
        {"dimmed_factor", 0.5, 0.0, 1.0, {}, "what a frame is multiplied by", "a test"}};
    append(info_.parameters, demodulateSchema().infos());
    info_.onHost = [this](int threads, const ParameterMap& parameters) -> HostFilter {
      threads_ = threads;
      const auto factor = float(std::get<double>(parameters.at("dimmed_factor")));
      return [this, factor](const HostFrame& frame) {
        ++frames_;
        given_ = frame;
        Image shown = frame.radiance;
        for (glm::vec3& pixel : shown.pixels) pixel *= factor;
        return shown;
      };
    };
    std::vector<const DenoiserInfo*> all = before_;
    all.push_back(&info_);
    registerMethods(integratorRegistry(), cacheRegistry(), all, missingDenoisers());
  }
  ~HostFilters() override {
    registerMethods(integratorRegistry(), cacheRegistry(), before_, missingDenoisers());
  }

  // Counts the pixels of `shown` that are `factor` times the filter's input; all others must be
  // unchanged.
  size_t dimmed(const Image& shown, float factor) const {
    size_t count = 0;
    for (size_t p = 0; p < shown.pixels.size(); ++p) {
      const bool isDimmed = shown.pixels[p] == factor * given_.radiance.pixels[p];
      EXPECT_TRUE(isDimmed || shown.pixels[p] == given_.radiance.pixels[p]) << p;
      count += isDimmed ? 1 : 0;
    }
    return count;
  }

  DenoiserInfo info_;
  HostFrame given_;
  int threads_ = -1;
  uint32_t frames_ = 0;

 private:
  std::vector<const DenoiserInfo*> before_;
};

void expectPass(const FrameStats& stats) {
  ASSERT_FALSE(stats.passes.empty());
  EXPECT_EQ(stats.passes.back().name, "dimmed");
  EXPECT_GT(stats.passes.back().timeMs, 0.0);
  double sum = 0.0;
  for (const PassTiming& pass : stats.passes) sum += pass.timeMs;
  EXPECT_NEAR(stats.timeMs, sum, 1e-9 * sum);
}

TEST_F(HostFilters, SeeTheLayersOfAnImage) {
  const glm::uvec2 size = {40, 20};
  const auto isLight = [](glm::uvec2 p) { return p.x / 4u == 3u && p.y / 4u == 2u; };
  const auto isBackground = [](glm::uvec2 p) { return p.y == 19u; };
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2 p) { return glm::vec3(1.0f + noiseAt(p, 0)); });
  frame.radiance.pixels[5 * 40 + 7].y = std::nanf("");
  frame.normalW = imageOf(size, [&](glm::uvec2 p) {
    return isBackground(p) ? glm::vec3(0.0f) : glm::vec3(0.6f, p.x < 20u ? 0.8f : -0.8f, 0.0f);
  });
  frame.albedo = imageOf(size, [](glm::uvec2 p) {
    return glm::vec3(0.1f + 0.8f * noiseAt(p, 1), 0.25f, p.x < 9u ? 0.9f : 0.5f);
  });
  frame.depthMetres =
      imageOf(size, [&](glm::uvec2 p) { return glm::vec3(isBackground(p) ? 0.0f : 2.0f); });
  frame.lights = imageOf(size, [&](glm::uvec2 p) { return glm::vec3(isLight(p) ? 1.0f : 0.0f); });

  ImageDenoiser denoiser(filterConfig("dimmed", size, 3));
  const Image shown = denoiser.frame(frame);
  EXPECT_EQ(threads_, 3);
  expectPass(denoiser.stats());
  EXPECT_EQ(denoiser.stats().health.counts[rl::RL_HEALTH_NONFINITE], 1u);
  for (size_t p = 0; p < shown.pixels.size(); ++p) {
    const glm::uvec2 at = {p % size.x, p / size.x};
    const bool isKept = isLight(at) || isBackground(at);
    const glm::vec3 radiance = p == 5 * 40 + 7 ? glm::vec3(0.0f) : frame.radiance.pixels[p];
    EXPECT_EQ(given_.radiance.pixels[p], radiance) << p;
    EXPECT_EQ(given_.normalW.pixels[p], frame.normalW.pixels[p]) << p;
    const glm::vec3 albedo = isKept ? glm::vec3(1.0f) : frame.albedo.pixels[p];
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(given_.albedo.pixels[p][c] / albedo[c], 1.0f, 1e-4f) << p;
    EXPECT_EQ(shown.pixels[p], (isKept ? 1.0f : 0.5f) * radiance) << p;
  }
}

TEST_F(HostFilters, AreNotToldReflectancesThatAreNotAskedFor) {
  const glm::uvec2 size = {8, 8};
  SessionConfig config = filterConfig("dimmed", size);
  config.parameters["demodulate"] = std::string("none");
  LayeredFrame frame;
  frame.radiance = Image(size.x, size.y, glm::vec3(1.0f));
  frame.albedo = Image(size.x, size.y, glm::vec3(0.5f));
  ImageDenoiser(config).frame(frame);
  for (const glm::vec3& albedo : given_.albedo.pixels) EXPECT_EQ(albedo, glm::vec3(1.0f));
}

class HostFiltersOfSessions : public HostFilters,
                              public testing::WithParamInterface<std::string> {};

// The shown image of a scene is the filtered image of the same frame without the filter.
TEST_P(HostFiltersOfSessions, MakeTheFrame) {
  if (GetParam() == "vulkan" && !vulkanBackendInfo().available)
    GTEST_SKIP() << "SKIPPED: " << vulkanBackendInfo().whyNot;
  const glm::uvec2 size = {32, 32};
  const size_t pixels = size_t(size.x) * size.y;
  const auto scene = bias::builtinScene("cornell-box");
  Session plain(scene, filterConfig("none", size, 1, GetParam()));
  Session filtered(scene, filterConfig("dimmed", size, 1, GetParam()));
  plain.frame();
  expectPass(filtered.frame());
  EXPECT_EQ(given_.radiance.pixels, plain.radiance().pixels);
  // The lamp is in view and stays unchanged.
  EXPECT_GT(dimmed(filtered.radiance(), 0.5f), pixels / 2);
  EXPECT_LT(dimmed(filtered.radiance(), 0.5f), pixels);
  EXPECT_EQ(filtered.aov("radiance").pixels, filtered.radiance().pixels);

  // Frames whose images are not read are filtered, too: their times must compare.
  for (const FrameStats& stats : filtered.frames(4)) expectPass(stats);
  EXPECT_EQ(frames_, 5u);
  for (int i = 0; i < 4; ++i) plain.frame();
  EXPECT_EQ(given_.radiance.pixels, plain.radiance().pixels);
  EXPECT_GT(dimmed(filtered.radiance(), 0.5f), pixels / 2);

  EXPECT_FALSE(filtered.setParameters({{"dimmed_factor", 0.25}}));
  filtered.frame();
  EXPECT_GT(dimmed(filtered.radiance(), 0.25f), pixels / 2);
  filtered.resize(16, 8);
  filtered.frame();
  EXPECT_EQ(given_.radiance.width, 16u);
  EXPECT_EQ(filtered.radiance().pixels.size(), 16u * 8u);
}

INSTANTIATE_TEST_SUITE_P(, HostFiltersOfSessions, testing::Values("cpu", "vulkan"),
                         [](const auto& test) { return test.param; });

TEST(MissingDenoisers, SayWhy) {
  const std::vector<const DenoiserInfo*> all = denoiserRegistry();
  const std::vector<MissingDenoiser> missing = missingDenoisers();
  registerMethods(integratorRegistry(), cacheRegistry(), all,
                  {{"absent", "a test's", "no network"}});
  try {
    findDenoiser("absent");
    ADD_FAILURE() << "it is there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    EXPECT_STREQ(error.what(), "denoiser absent is not there: no network");
  }
  EXPECT_EQ(findDenoiser("none").name, "none");
  registerMethods(integratorRegistry(), cacheRegistry(), all, missing);
}

}  // namespace
}  // namespace restlab::denoise
