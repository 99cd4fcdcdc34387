// In a still view the shift over time is the identity: without spatial donors restir_gi shows the
// exponential average of its own initial samples, for any surfaces: mirrors, glass, lamps in view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/conformance/variants.h"

namespace restlab {
namespace {

class ReuseOverTime : public ::testing::TestWithParam<const char*> {};

TEST_P(ReuseOverTime, IsTheExponentialAverage) {
  const auto scene = bias::builtinScene(GetParam());
  SessionConfig config;
  config.integrator = "restir_gi";
  config.width = 48;
  config.height = 27;
  config.threads = 1;
  config.parameters = {{"spatial_neighbours", int64_t{0}},
                       {"confidence_cap", 6.0},
                       {"light_edge_samples", int64_t{0}}};
  Session reused(scene, config);
  config.parameters["temporal"] = false;
  Session fresh(scene, config);
  std::vector<glm::dvec3> expected(fresh.radiance().pixels.size(), glm::dvec3(0.0));
  for (uint32_t frame = 0; frame < 20; ++frame) {
    const FrameStats stats = reused.frame();
    fresh.frame();
    const auto temporal =
        std::find_if(stats.passes.begin(), stats.passes.end(),
                     [](const PassTiming& pass) { return pass.name == "temporal"; });
    ASSERT_NE(temporal, stats.passes.end());
    EXPECT_EQ(temporal->raysPath + temporal->raysShadow, 0u);
    const double weight = 1.0 / (std::min(double(frame), 6.0) + 1.0);
    double largest = 0.0, mean = 0.0;
    for (size_t p = 0; p < expected.size(); ++p) {
      expected[p] += weight * (glm::dvec3(fresh.radiance().pixels[p]) - expected[p]);
      for (int c = 0; c < 3; ++c) {
        mean += expected[p][c] / double(3 * expected.size());
        largest =
            std::max(largest, std::abs(double(reused.radiance().pixels[p][c]) - expected[p][c]) /
                                  (std::abs(expected[p][c]) + 1e-2));
      }
    }
    ASSERT_GT(mean, 0.0);
    ASSERT_LT(largest, 1e-3) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, ReuseOverTime,
                         ::testing::Values("cornell-box", "glossy-gallery", "glass", "courtyard"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace restlab
