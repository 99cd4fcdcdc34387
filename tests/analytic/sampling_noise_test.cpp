// Sampling proportional to the contribution has no noise; nearly proportional sampling has little.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::analytic {
namespace {

// Statistics of single frames, over all pixels.
struct Spread {
  double mean = 0.0, relativeVariance = 0.0, furthest = 0.0;  // furthest: largest |pixel - mean|
};

Spread spreadOf(const std::string& scene, uint32_t maxBounces, uint32_t frames) {
  SessionConfig config;
  config.width = 32;
  config.height = 18;
  config.threads = 1;
  config.integrator = "path";
  config.maxBounces = maxBounces;
  Session session(CompiledScene::build(makeBuiltinScene(scene)), config);
  double sum = 0.0, squares = 0.0, low = 1e30, high = -1e30;
  size_t count = 0;
  for (uint32_t f = 0; f < frames; ++f) {
    session.frame();
    for (const glm::vec3& p : session.radiance().pixels) {
      const double value = double(p.y);
      sum += value;
      squares += value * value;
      low = std::min(low, value);
      high = std::max(high, value);
      ++count;
    }
  }
  Spread s;
  s.mean = sum / double(count);
  s.relativeVariance = squares / double(count) / (s.mean * s.mean) - 1.0;
  s.furthest = std::max(high - s.mean, s.mean - low);
  return s;
}

// Smooth glass reflects exactly the Fresnel term of the viewing direction. With a tenth of the
// paths for a reflection that has a hundred-thousandth of the light, pixels were 1.21 or 0.0006.
TEST(SamplingNoise, SmoothGlassHasNone) {
  for (const char* scene : {"floor?ior=1.0001", "floor?ior=1.01", "floor?ior=1.5", "floor?ior=3"}) {
    const Spread s = spreadOf(scene, 64, 8);
    EXPECT_NEAR(s.mean, 1.0, 1e-3) << scene;
    EXPECT_LT(s.furthest, 2e-3) << scene;
  }
}

// Bilinear interpolation spreads a sun of one pixel. Drawing texels by their interpolated mean
// leaves a relative variance of 1.1; the plain mean of the 3 x 3 neighbourhood gave 3.
TEST(SamplingNoise, TexelsAreDrawnByTheirMean) {
  const Spread s = spreadOf("floor?sun=1e9", 1, 64);
  EXPECT_GT(s.relativeVariance, 0.9);
  EXPECT_LT(s.relativeVariance, 1.3);
}

}  // namespace
}  // namespace restlab::analytic
