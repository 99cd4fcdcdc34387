// In a still view nothing comes from another camera: modes and caches of an integrator with
// reservoirs show one image, bit for bit. What tells them apart is motion.
#include <gtest/gtest.h>

#include <optional>

#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

constexpr uint32_t kFrames = 24;

Image stillImage(const std::string& scene, const Variant& variant) {
  Session session(bias::builtinScene(scene), configOf(variant, 32, 18));
  for (uint32_t frame = 0; frame < kFrames; ++frame) session.frame();
  return session.radiance();
}

TEST(StillView, ModesAndCachesShowOneImage) {
  for (const char* scene : {"cornell-box", "door-ajar", "glossy-gallery"}) {
    std::optional<Image> first;
    size_t compared = 0;
    for (const Variant& variant : allVariants()) {
      if (variant.cache.empty() || variant.endsPaths) continue;
      const Image image = stillImage(scene, variant);
      if (!first) first = image;
      EXPECT_EQ(countDifferent(image, *first), 0u) << scene << ", " << variant.name();
      ++compared;
    }
    EXPECT_GE(compared, 6u);
  }
}

}  // namespace
}  // namespace restlab::conformance
