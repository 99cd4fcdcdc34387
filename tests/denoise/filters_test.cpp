// Rules for every denoiser that filters by guides, on synthetic images.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/frame/method.h"
#include "core/image/metrics/metrics.h"
#include "tests/denoise/layered_images.h"

namespace restlab::denoise {
namespace {

class Filters : public testing::TestWithParam<std::string> {
 protected:
  SessionConfig config(glm::uvec2 size, int threads = 1, const char* backend = "cpu") const {
    return filterConfig(GetParam(), size, threads, backend);
  }
};

double mean(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels) sum += pixel.y;
  return sum / double(image.pixels.size());
}
double squareError(const Image& image, float truth) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels) sum += std::pow(double(pixel.y) - truth, 2.0);
  return sum / double(image.pixels.size());
}

TEST_P(Filters, ConstantsPassUnchanged) {
  const glm::uvec2 size = {70, 40};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(3.0f, 0.2f, 700.0f); });
  for (int i = 0; i < 3; ++i) {
    for (const glm::vec3& pixel : denoiser.frame(frame).pixels) {
      EXPECT_NEAR(pixel.x, 3.0f, 3e-5f);
      EXPECT_NEAR(pixel.y, 0.2f, 2e-6f);
      EXPECT_NEAR(pixel.z, 700.0f, 7e-3f);
    }
  }
}

// Constant light on a texture.
TEST_P(Filters, TexturesStaySharp) {
  const glm::uvec2 size = {64, 32};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.albedo = imageOf(size, [](glm::uvec2 p) {
    return glm::vec3(0.1f + 0.8f * noiseAt(p, 1), 0.5f, (p.x / 4u) % 2u == 0u ? 0.9f : 0.05f);
  });
  frame.radiance = frame.albedo;
  for (glm::vec3& pixel : frame.radiance.pixels) pixel *= 2.0f;
  const Image shown = denoiser.frame(frame);
  for (size_t p = 0; p < shown.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(shown.pixels[p][c] / frame.radiance.pixels[p][c], 1.0f, 1e-3f) << p;
  }
}

// Only pixels from which the filter reaches equally far to the left and to the right.
TEST_P(Filters, LinearImagesPassUnchanged) {
  const glm::uvec2 size = {200, 24};
  const uint32_t reach = 66;  // reach of five iterations and a variance estimate
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2 p) { return glm::vec3(1.0f + 0.01f * float(p.x)); });
  const Image shown = denoiser.frame(frame);
  for (uint32_t y = 0; y < size.y; ++y) {
    for (uint32_t x = reach; x < size.x - reach; ++x) {
      const float expected = 1.0f + 0.01f * float(x);
      EXPECT_NEAR(shown.pixels[size_t(y) * size.x + x].x / expected, 1.0f, 1e-5f) << x << "," << y;
    }
  }
}

// A step of light at an edge of depth, and at an edge of normals.
TEST_P(Filters, NothingBleedsOverEdges) {
  const glm::uvec2 size = {64, 24};
  for (const bool byNormal : {false, true}) {
    ImageDenoiser denoiser(config(size));
    const auto isLeft = [](glm::uvec2 p) { return p.x < 31u; };
    LayeredFrame frame;
    if (byNormal) {
      frame.normalW = imageOf(size, [&](glm::uvec2 p) {
        return isLeft(p) ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.8f, 0.0f, 0.6f);
      });
    } else {
      frame.depthMetres =
          imageOf(size, [&](glm::uvec2 p) { return glm::vec3(isLeft(p) ? 2.0f : 2.5f); });
    }
    Image shown;
    for (uint32_t i = 0; i < 4; ++i) {
      frame.radiance = imageOf(size, [&](glm::uvec2 p) {
        return glm::vec3(isLeft(p) ? 1.8f + 0.4f * noiseAt(p, i) : 0.0f);
      });
      shown = denoiser.frame(frame);
    }
    // Means over columns: the noise of single pixels does not matter here.
    for (uint32_t x = 0; x < size.x; ++x) {
      double column = 0.0;
      for (uint32_t y = 0; y < size.y; ++y)
        column += shown.pixels[size_t(y) * size.x + x].x / double(size.y);
      if (isLeft({x, 0u})) {
        EXPECT_GT(column, 0.95 * 2.0) << x << (byNormal ? ", normals" : ", depth");
      } else {
        EXPECT_LT(column, 0.05 * 2.0) << x << (byNormal ? ", normals" : ", depth");
      }
    }
  }
}

TEST_P(Filters, WhatIsNotFiniteStaysAPixelsMatter) {
  const glm::uvec2 size = {40, 20};
  const float bad[] = {std::nanf(""), std::numeric_limits<float>::infinity()};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(2.0f); });
  frame.radiance.pixels[5 * 40 + 7].y = bad[0];
  frame.radiance.pixels[11 * 40 + 30].z = bad[1];
  frame.radiance.pixels[15 * 40 + 20].x = 1.0e30f;
  const Image shown = denoiser.frame(frame);
  EXPECT_EQ(denoiser.stats().health.counts[rl::RL_HEALTH_NONFINITE], 3u);
  for (size_t p = 0; p < shown.pixels.size(); ++p) {
    const bool isBad = p == 5 * 40 + 7 || p == 11 * 40 + 30 || p == 15 * 40 + 20;
    if (isBad) {
      EXPECT_TRUE(std::isfinite(shown.pixels[p].x + shown.pixels[p].y + shown.pixels[p].z));
    } else {
      EXPECT_NEAR(shown.pixels[p].y, 2.0f, 2e-5f) << p;
    }
  }
}

// When the image moves, neighbours must not take a pixel without a history for a black one.
TEST_P(Filters, WhatIsNotFiniteLeavesNoBlackHistory) {
  const glm::uvec2 size = {40, 20};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(2.0f); });
  frame.radiance.pixels[5 * 40 + 7].y = std::nanf("");
  denoiser.frame(frame);
  frame.radiance.pixels[5 * 40 + 7].y = 2.0f;
  frame.motion = imageOf(size, [](glm::uvec2) { return glm::vec3(0.5f, 0.0f, 0.0f); });
  for (int i = 0; i < 2; ++i) {
    for (const glm::vec3& pixel : denoiser.frame(frame).pixels) EXPECT_NEAR(pixel.y, 2.0f, 2e-5f);
  }
}

// Bounds of similarity may overflow to infinity.
TEST_P(Filters, WideDeviationsOfLargeNumbersStayFinite) {
  const glm::uvec2 size = {24, 12};
  SessionConfig wide = config(size);
  for (const ParameterInfo& parameter : findMethod(wide).parameters()) {
    if (parameter.name.ends_with("_deviations"))
      wide.parameters[parameter.name] = parameter.maxValue;
  }
  ImageDenoiser denoiser(wide);
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(1.0f); });
  frame.radiance.pixels[6 * 24 + 12] = glm::vec3(1.0e19f);
  EXPECT_EQ(countNonfinite(denoiser.frame(frame)), 0u);
}

// Other renderers write a large depth and no normal for the background.
TEST_P(Filters, WhatHasNoNormalIsTheBackground) {
  const glm::uvec2 size = {32, 16};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance =
      imageOf(size, [](glm::uvec2 p) { return glm::vec3(p.x == 8u && p.y == 8u ? 100.0f : 1.0f); });
  frame.normalW =
      imageOf(size, [](glm::uvec2 p) { return glm::vec3(p.x < 16u ? 0.0f : 1.0f, 0, 0); });
  frame.depthMetres =
      imageOf(size, [](glm::uvec2 p) { return glm::vec3(p.x < 16u ? 1e10f : 2.0f); });
  EXPECT_EQ(denoiser.frame(frame).pixels[8 * 32 + 8], glm::vec3(100.0f));
  denoiser.frame(frame);
  EXPECT_EQ(denoiser.stats().health.counts[rl::RL_HEALTH_NEW_HISTORY], 0u);
}

TEST_P(Filters, LightsAndTheirNeighboursAreKeptApart) {
  const glm::uvec2 size = {32, 32};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  const auto isLight = [](glm::uvec2 p) { return p.x / 4u == 3u && p.y / 4u == 3u; };
  frame.lights = imageOf(size, [&](glm::uvec2 p) { return glm::vec3(isLight(p) ? 1.0f : 0.0f); });
  frame.radiance = imageOf(size, [&](glm::uvec2 p) {
    return isLight(p) ? glm::vec3(1000.0f + float(p.x)) : glm::vec3(1.0f);
  });
  const Image shown = denoiser.frame(frame);
  for (uint32_t p = 0; p < size.x * size.y; ++p) {
    if (GetParam() == "firefly" && !isLight({p % size.x, p / size.x})) continue;
    EXPECT_NEAR(shown.pixels[p].x / frame.radiance.pixels[p].x, 1.0f, 1e-5f) << p;
  }
}

TEST_P(Filters, ThreadsChangeNoBit) {
  const glm::uvec2 size = {150, 70};
  ImageDenoiser one(config(size, 1)), many(config(size, 7));
  LayeredFrame frame;
  frame.normalW = imageOf(size, [](glm::uvec2 p) {
    return glm::normalize(glm::vec3(0.2f * std::sin(float(p.x) * 0.1f), 0.1f, 1.0f));
  });
  for (uint32_t i = 0; i < 3; ++i) {
    frame.radiance = imageOf(size, [&](glm::uvec2 p) { return glm::vec3(noiseAt(p, i)); });
    const Image a = one.frame(frame), b = many.frame(frame);
    EXPECT_TRUE(a.pixels == b.pixels) << "frame " << i;
  }
}

TEST_P(Filters, ImagesOfAnySize) {
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(1, 37), glm::uvec2(37, 1),
                                glm::uvec2(2, 3), glm::uvec2(16384, 3)}) {
    ImageDenoiser denoiser(config(size));
    LayeredFrame frame;
    for (uint32_t i = 0; i < 2; ++i) {
      frame.radiance = imageOf(size, [&](glm::uvec2 p) { return glm::vec3(1.0f + noiseAt(p, i)); });
      for (const glm::vec3& pixel : denoiser.frame(frame).pixels) {
        EXPECT_GE(pixel.x, 1.0f - 1e-5f);
        EXPECT_LE(pixel.x, 2.0f + 1e-5f);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Filters, testing::ValuesIn(filters()),
                         [](const auto& test) { return test.param; });

// Denoisers that average.
class Averaging : public Filters {};

TEST_P(Averaging, NoiseFallsAndTheMeanStays) {
  const glm::uvec2 size = {96, 64};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  // Few pixels are bright, as in path tracing.
  frame.radiance =
      imageOf(size, [](glm::uvec2 p) { return glm::vec3(noiseAt(p, 3) < 0.1f ? 10.0f : 0.0f); });
  const double before = squareError(frame.radiance, 1.0f);
  const Image shown = denoiser.frame(frame);
  EXPECT_LT(squareError(shown, 1.0f), 0.05 * before);
  EXPECT_NEAR(mean(shown) / mean(frame.radiance), 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(, Averaging, testing::Values("atrous", "svgf", "svgf_restir"),
                         [](const auto& test) { return test.param; });

// Denoisers with a history.
class Remembering : public Filters {};

// Tests the history without the filter.
TEST_P(Remembering, ErrorsFallFromFrameToFrame) {
  const glm::uvec2 size = {64, 48};
  SessionConfig history = config(size);
  history.parameters["svgf_iterations"] = int64_t{0};
  ImageDenoiser denoiser(history);
  std::vector<double> errors;
  LayeredFrame frame;
  for (uint32_t i = 0; i < 20; ++i) {
    frame.radiance =
        imageOf(size, [&](glm::uvec2 p) { return glm::vec3(noiseAt(p, i) < 0.1f ? 10.0f : 0.0f); });
    errors.push_back(squareError(denoiser.frame(frame), 1.0f));
  }
  EXPECT_LT(errors[3], errors[0]);
  EXPECT_LT(errors[19], 0.1 * errors[0]);
}

// Content that moves by whole pixels is found at its old position.
TEST_P(Remembering, HistoriesFollowMotion) {
  const glm::uvec2 size = {64, 48};
  ImageDenoiser moving(config(size)), still(config(size));
  const auto pattern = [](glm::uvec2 p, uint32_t shift) {
    return glm::vec3(1.0f + ((p.x + shift) / 8u + p.y / 8u) % 2u);
  };
  LayeredFrame a, b;
  a.motion = imageOf(size, [](glm::uvec2) { return glm::vec3(3.0f, 0.0f, 0.0f); });
  double movingError = 0.0, stillError = 0.0;
  for (uint32_t i = 0; i < 8; ++i) {
    const auto noisy = [&](uint32_t shift) {
      return imageOf(size, [&](glm::uvec2 p) {
        return pattern(p, shift) * (0.5f + noiseAt({p.x + 1000u, p.y}, i));
      });
    };
    a.radiance = noisy(3u * i);
    b.radiance = noisy(0u);
    // The pattern moves to the left: its old position is to the right.
    const Image shownA = moving.frame(a), shownB = still.frame(b);
    movingError = stillError = 0.0;
    for (uint32_t y = 0; y < size.y; ++y) {
      for (uint32_t x = 0; x < 30; ++x) {
        const size_t p = size_t(y) * size.x + x;
        movingError += std::pow(double(shownA.pixels[p].x - pattern({x, y}, 3u * i).x), 2.0);
        stillError += std::pow(double(shownB.pixels[p].x - pattern({x, y}, 0u).x), 2.0);
      }
    }
  }
  EXPECT_LT(movingError, 1.5 * stillError);
  EXPECT_GT(stillError, 0.0);
}

// Everything leaves the view: no history is left, and the health count says so.
TEST_P(Remembering, ACutBeginsAnew) {
  const glm::uvec2 size = {32, 16};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(8.0f); });
  for (int i = 0; i < 5; ++i) denoiser.frame(frame);
  EXPECT_EQ(denoiser.stats().health.counts[rl::RL_HEALTH_NEW_HISTORY], 0u);
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(1.0f); });
  frame.motion = imageOf(size, [](glm::uvec2) { return glm::vec3(1.0e4f, 0.0f, 0.0f); });
  for (const glm::vec3& pixel : denoiser.frame(frame).pixels) EXPECT_NEAR(pixel.x, 1.0f, 1e-5f);
  EXPECT_EQ(denoiser.stats().health.counts[rl::RL_HEALTH_NEW_HISTORY], size.x * size.y);
}

INSTANTIATE_TEST_SUITE_P(, Remembering, testing::Values("svgf", "svgf_restir"),
                         [](const auto& test) { return test.param; });

TEST(Firefly, IsDarkenedToItsNeighboursAndCounted) {
  const glm::uvec2 size = {20, 20};
  ImageDenoiser denoiser(filterConfig("firefly", size));
  LayeredFrame frame;
  frame.radiance = imageOf(size, [](glm::uvec2) { return glm::vec3(1.0f, 2.0f, 4.0f); });
  frame.radiance.pixels[205] *= 50.0f;
  const Image shown = denoiser.frame(frame);
  EXPECT_EQ(denoiser.stats().health.counts[rl::RL_HEALTH_FIREFLIES], 1u);
  EXPECT_NEAR(shown.pixels[205].y, 2.0f, 1e-4f);
  EXPECT_EQ(shown.pixels[204], frame.radiance.pixels[204]);
}

}  // namespace
}  // namespace restlab::denoise
