// Filters on images with depths and normals but without planes: the slope of the depth on a surface
// is estimated from neighbours (core/gbuffer/layers.glsl).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/denoise/layered_images.h"

namespace restlab::denoise {
namespace {

class Slopes : public testing::TestWithParam<std::string> {};

// Receding floor: its disparity falls linearly over the film. Depths are taken at a random point in
// each pixel, as renderers with a film filter do.
LayeredFrame floorFrame(glm::uvec2 size, float perPixel, uint32_t frame) {
  LayeredFrame f;
  f.radiance = imageOf(size, [&](glm::uvec2 p) { return glm::vec3(2.0f * noiseAt(p, frame)); });
  f.normalW = imageOf(size, [](glm::uvec2) { return glm::vec3(0.0f, 1.0f, 0.0f); });
  f.depthMetres = imageOf(size, [&](glm::uvec2 p) {
    const float y = float(p.y) + noiseAt(p, frame + 77u);
    return glm::vec3(1.0f / (0.05f + perPixel * y));
  });
  return f;
}

double varianceOf(const Image& image) {
  double sum = 0.0, squares = 0.0;
  for (const glm::vec3& p : image.pixels) {
    sum += p.x;
    squares += double(p.x) * p.x;
  }
  const double n = double(image.pixels.size());
  return squares / n - sum / n * (sum / n);
}

TEST_P(Slopes, GrazingSurfacesAreFilteredAsOthersAre) {
  const glm::uvec2 size = {96, 96};
  const auto variance = [&](float perPixel) {
    ImageDenoiser denoiser(filterConfig(GetParam(), size));
    Image shown;
    for (uint32_t i = 0; i < 3; ++i) shown = denoiser.frame(floorFrame(size, perPixel, i));
    return varianceOf(shown);
  };
  const double frontal = variance(0.0f);
  for (const float perPixel : {0.001f, 0.005f, 0.02f})
    EXPECT_LT(variance(perPixel), 2.5 * frontal) << perPixel << " per metre and pixel";
}

// A bright strip in front of a parallel dark wall, or in its plane with another normal (`behind` =
// 1). Both are so noisy that their light does not tell them apart.
TEST_P(Slopes, ThinStripsKeepTheirLight) {
  const glm::uvec2 size = {64, 96};
  for (const uint32_t width : {1u, 2u, 3u, 4u, 5u, 8u, 12u}) {
    for (const float behind : {1.0f, 1.05f, 1.1f, 1.3f}) {
      ImageDenoiser denoiser(filterConfig(GetParam(), size));
      const auto isStrip = [&](glm::uvec2 p) { return p.x >= 30u && p.x < 30u + width; };
      const auto stripMean = [&](const Image& image) {
        double sum = 0.0;
        for (uint32_t y = 0; y < size.y; ++y) {
          for (uint32_t x = 0; x < size.x; ++x)
            sum += isStrip({x, y}) ? image.pixels[size_t(y) * size.x + x].x : 0.0;
        }
        return sum / (double(width) * size.y);
      };
      LayeredFrame frame;
      const glm::vec3 other = behind == 1.0f ? glm::vec3(0.8f, 0.0f, 0.6f) : glm::vec3(0, 0, 1);
      frame.normalW = imageOf(
          size, [&](glm::uvec2 p) { return isStrip(p) ? other : glm::vec3(0.0f, 0.0f, 1.0f); });
      frame.depthMetres =
          imageOf(size, [&](glm::uvec2 p) { return glm::vec3(isStrip(p) ? 2.0f : 2.0f * behind); });
      frame.radiance = imageOf(size, [&](glm::uvec2 p) {
        return glm::vec3(isStrip(p) && noiseAt(p, 1) < 0.1f ? 20.0f : 0.0f);
      });
      const double before = stripMean(frame.radiance);
      EXPECT_GT(stripMean(denoiser.frame(frame)), 0.95 * before)
          << width << " wide, wall at " << behind;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Slopes, testing::Values("atrous", "svgf", "svgf_restir"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace restlab::denoise
