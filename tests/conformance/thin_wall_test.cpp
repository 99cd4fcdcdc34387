// A bright and a dark room share floor and ceiling, with a wall of a millimetre between them: light
// cached in one room must not appear in the other.
#include <gtest/gtest.h>

#include "core/caches/entries/settings.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/bias/test_cameras.h"
#include "tests/bias/few_entries.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

std::shared_ptr<const CompiledScene> twoRooms() {
  builtin::SceneBuilder scene("two-rooms");
  const uint32_t white = scene.addMaterial("white", builtin::lambert(glm::vec3(0.8f)));
  const uint32_t lamp = scene.addMaterial("lamp", builtin::lamp(glm::vec3(20.0f)));
  scene.add(builtin::insideOut(builtin::box("rooms", {-2.0, 0.0, -1.0}, {2.0, 2.0, 1.0})), white);
  scene.add(builtin::box("wall", {-0.0005, -0.1, -1.1}, {0.0005, 2.1, 1.1}), white);
  scene.add(builtin::quad("lamp", {0.2, 1.99, -0.5}, {0.6, 0.0, 0.0}, {0.0, 0.0, 1.0}), lamp);
  scene.addCamera("front", {0.9, 1.0, 0.9}, {0.0, 0.0, -0.3}, 60.0);
  return CompiledScene::build(scene.finish());
}

double meanOf(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += double(p.x + p.y + p.z) / 3.0;
  return sum / double(image.pixels.size());
}

class ThinWall : public ::testing::TestWithParam<Variant> {};

TEST_P(ThinWall, TheDarkRoomStaysDark) {
  const auto scene = twoRooms();
  SessionConfig config = configOf(GetParam(), 64, 48);
  // Makes cells and discs reach through the wall.
  const ParameterMap wide = {{config.cache + "_pixels", 24.0},
                             {"entry_spread", 4.0},
                             {"radiance_pixels", 64.0},
                             {"radiance_footprint", 0.1},
                             {"radiance_least", int64_t{1}}};
  for (const ParameterInfo& p : findMethod(config).parameters()) {
    if (wide.contains(p.name)) config.parameters[p.name] = wide.at(p.name);
  }
  // The biased mode assumes that the last frame's sample is visible, even if the camera came
  // through the wall. That bias is declared and not caused by a cache.
  const bool assumesVisible = GetParam().mode == "biased";
  const bool hasEntries = config.parameters.contains(kEntryCount);
  if (assumesVisible && hasEntries) config.parameters["reproject"] = false;
  if (bias::hasElements(config)) config.parameters["elements"] = int64_t{8192};
  Session session(scene, config);
  double bright = 0.0, dark = 0.0;
  for (int turn = 0; turn < 4; ++turn) {
    for (const double side : {1.0, -1.0}) {
      session.setCamera(bias::lookAt({0.9 * side, 1.0, 0.9}, {0.02 * side, 0.0, -0.3}, 60.0));
      for (int i = 0; i < 12; ++i) {
        session.frame();
        (side > 0.0 ? bright : dark) += meanOf(session.radiance());
      }
    }
  }
  EXPECT_GT(bright, 1.0);
  double allowed = assumesVisible && !hasEntries ? 1.0e-2 : 1.0e-4;
  // Elements of the floor reach through below the wall.
  if (bias::hasElements(config)) allowed = 0.05;
  EXPECT_LT(dark, allowed * bright);
}

std::vector<Variant> variantsWithoutDenoiser() {
  std::vector<Variant> all = allVariants();
  std::erase_if(all, [](const Variant& v) { return v.denoiser != "none"; });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, ThinWall, ::testing::ValuesIn(byDay(variantsWithoutDenoiser())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, ThinWall, ::testing::ValuesIn(byNight(variantsWithoutDenoiser())),
                         VariantName());

}  // namespace
}  // namespace restlab::conformance
