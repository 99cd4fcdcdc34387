// In a still view nothing comes from another camera: all modes and caches of an integrator with
// reservoirs show one image, bit for bit. Only motion makes them differ.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/scene/scene.h"
#include "tests/bias/test_cameras.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

constexpr uint32_t kStillFrames = 24;

Image stillImage(const std::string& scene, const Variant& variant) {
  Session session(bias::builtinScene(scene), configOf(variant, 32, 18));
  for (uint32_t frame = 0; frame < kStillFrames; ++frame) session.frame();
  return session.radiance();
}

TEST(StillView, ModesAndCachesShowOneImage) {
  for (const char* scene : {"cornell-box", "door-ajar", "glossy-gallery"}) {
    std::map<std::string, Image> firstOf;  // by integrator
    size_t compared = 0;
    for (const Variant& variant : allVariants()) {
      if (variant.cache.empty() || variant.endsPaths) continue;
      const Image image = stillImage(scene, variant);
      const Image& first = firstOf.emplace(variant.integrator, image).first->second;
      EXPECT_EQ(countDifferent(image, first), 0u) << scene << ", " << variant.name();
      ++compared;
    }
    EXPECT_GE(compared, 6u);
  }
}

// Proves that the test above can fail: modes and caches have an effect once the camera moves.
TEST(StillView, InAMovingOneTheyDiffer) {
  const SceneCamera end = makeBuiltinScene("cornell-box").cameras.at(0);
  const std::vector<SceneCamera> cameras = bias::walkTo(end, 12, {0.06, 0.01, -0.05}, 1.5);
  std::vector<Image> images;
  for (const Variant& variant : allVariants()) {
    if (variant.cache.empty() || variant.endsPaths) continue;
    Session session(bias::builtinScene("cornell-box"), configOf(variant, 32, 18));
    for (const SceneCamera& camera : cameras) {
      session.setCamera(camera);
      session.frame();
    }
    for (const Image& other : images) EXPECT_GT(countDifferent(session.radiance(), other), 0u);
    images.push_back(session.radiance());
  }
}

}  // namespace
}  // namespace restlab::conformance
