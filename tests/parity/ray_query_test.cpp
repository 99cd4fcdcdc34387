// Ray queries of a device against the project's own hierarchy on that device and against Embree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "core/backend/vulkan_device.h"
#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/parity/everything_scene.h"

namespace restlab::parity {
namespace {

constexpr uint32_t kFrames = 4;

struct QueryCase {
  const char* name;
  Scene (*make)();
  const char* integrator;
};

Scene everything() { return makeEverythingScene(); }
// Adds partly transparent blocks in the middle of the room, one in front of the other, beside
// opaque instances of the same mesh.
Scene alphaInstances() {
  Scene scene = makeEverythingScene();
  scene.materials.push_back(scene.materials[scene.instances.back().material]);
  rl::Material& material = scene.materials.back().data;
  material.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  material.alpha = 0.6f;
  MeshInstance block = scene.instances.back();
  block.material = static_cast<uint32_t>(scene.materials.size() - 1);
  for (const double side : {-1.0, 1.0}) {
    block.objectToWorld =
        glm::rotate(glm::translate(glm::dmat4(1.0), {-2.8 + 1.5 * side, 2.2, -0.4 + 0.7 * side}),
                    0.5, {1.0, 2.0, 3.0});
    block.objectToWorld = glm::scale(block.objectToWorld, {side, 1.2, 0.8});
    scene.instances.push_back(block);
  }
  return scene;
}
Scene cornell() { return makeBuiltinScene("cornell-box"); }
Scene glass() { return makeBuiltinScene("glass"); }

Image render(const std::shared_ptr<const CompiledScene>& scene, const QueryCase& c,
             const std::string& backend, const std::string& rayTracing) {
  SessionConfig config;
  config.integrator = c.integrator;
  config.backend = backend;
  config.rayTracing = rayTracing;
  config.width = 64;
  config.height = 36;
  config.seed = 5;
  Session session(scene, config);
  EXPECT_EQ(session.rayTracing(), rayTracing);
  Image sum;
  for (uint32_t f = 0; f < kFrames; ++f) {
    session.frame();
    const Image& image = session.radiance();
    if (f == 0) {
      sum = image;
      continue;
    }
    for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
  }
  return sum;
}

class RayQuery : public testing::TestWithParam<QueryCase> {
 protected:
  void SetUp() override {
    setenv("XDG_CACHE_HOME", RESTLAB_RAY_QUERY_CACHE, 1);
    const std::vector<VulkanDeviceInfo> devices = vulkanDeviceInfos();
    if (devices.empty() || !devices[0].whyNot.empty() || !devices[0].hasRayQuery)
      GTEST_SKIP() << "SKIPPED: no Vulkan device with ray queries";
  }
};

TEST_P(RayQuery, SameSeedSameImage) {
  const QueryCase& c = GetParam();
  const auto scene = CompiledScene::build(c.make());
  const Image query = render(scene, c, "vulkan", "query");
  const auto expectAlike = [&](const char* who, const Image& other) {
    size_t different = 0;
    double mean = 0.0, meanOther = 0.0, squares = 0.0;
    for (size_t i = 0; i < query.pixels.size(); ++i) {
      const glm::dvec3 a(query.pixels[i]), b(other.pixels[i]);
      const double scale = std::max(glm::length(a), glm::length(b));
      if (!(glm::length(a - b) <= 1e-3 * scale)) ++different;
      mean += a.x + a.y + a.z;
      meanOther += b.x + b.y + b.z;
      squares += glm::dot(a - b, a - b) / (3.0 * kFrames * kFrames);
    }
    const double share = double(different) / double(query.pixels.size());
    std::printf("  query against %s: %.2f %% of the pixels differ, MSE %.3g, means by %.2g\n", who,
                100.0 * share, squares / double(query.pixels.size()),
                std::abs(mean / meanOther - 1.0));
    EXPECT_GT(mean, 0.0);
    // Paths that hit an edge, or a surface at a grazing angle, may diverge.
    EXPECT_LT(share, 0.01 * kFrames) << who;
    EXPECT_NEAR(mean / meanOther, 1.0, 0.01) << who;
  };
  expectAlike("bvh", render(scene, c, "vulkan", "bvh"));
  expectAlike("Embree", render(scene, c, "cpu", "embree"));
}

INSTANTIATE_TEST_SUITE_P(, RayQuery,
                         testing::Values(QueryCase{"CornellBox", cornell, "restir_gi"},
                                         QueryCase{"Glass", glass, "path"},
                                         QueryCase{"Everything", everything, "path"},
                                         QueryCase{"AlphaInstances", alphaInstances, "path"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace restlab::parity
