// Lights set in a viewer: a factor for all lights on top of each light's own, and their form in
// suites.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/scene/compiled/light_factor.h"
#include "experiments/view/live_view.h"
#include "experiments/view/view_session.h"
#include "tests/runner/temporary_folder.h"
#include "tests/view/small_panes.h"

namespace restlab::view_test {
namespace {

TEST(ViewLights, OfAllIsOnTopOfTheirOwn) {
  LightFactors lights;
  setLight(lights, "lamp", 0.5);
  setLight(lights, kAllLights, 4.0);
  EXPECT_EQ(lights, (LightFactors{{"lamp", 0.5}, {kAllLights, 4.0}}));
  EXPECT_EQ(absoluteLights(lights), (LightFactors{{kAllLights, 4.0}, {"lamp", 2.0}}));
  setLight(lights, kAllLights, 1.0);
  EXPECT_EQ(lights, (LightFactors{{"lamp", 0.5}})) << "it has its own again";
  setLight(lights, "lamp", 1.0);
  EXPECT_TRUE(lights.empty()) << "which is the scene as it was loaded";
}

// A mesh and its material may name the same light; the last factor counts, even a 1.
TEST(ViewLights, KeepAOneThatCounts) {
  LightFactors lights;
  setLight(lights, "material", 0.5);
  setLight(lights, "mesh", 1.0);
  EXPECT_EQ(absoluteLights(lights), (LightFactors{{"material", 0.5}, {"mesh", 1.0}}));
}

class ViewLightsTest : public TemporaryFolder {
 protected:
  static LiveView open() { return {cornellBox(), {smallPane("restir_gi"), smallPane("path")}, {}}; }
  static std::string light() { return lightNames(cornellBox().scene->source()).front(); }
};

TEST_F(ViewLightsTest, FactorsMultiply) {
  LiveView view = open(), other = open();
  view.apply(SetLight{light(), 0.5});
  view.apply(SetLight{kAllLights, 3.0});
  other.apply(SetLight{light(), 1.5});
  for (LiveView* one : {&view, &other}) one->renderFrames();
  EXPECT_EQ(view.session(1).radiance().pixels, other.session(1).radiance().pixels)
      << "the box has one light";
}

TEST_F(ViewLightsTest, AreTheSameAsEventsOfASuite) {
  const auto file = folder() / "suite.toml";
  const auto again = [&](const LightFactors& lights) {
    std::string suite =
        "scenes = [\"cornell-box\"]\n[settings]\nwidth = 24\nheight = 16\n"
        "[[method]]\nintegrator = \"restir_gi\"\n[[method]]\nintegrator = \"path\"\n";
    for (const auto& [name, factor] : absoluteLights(lights)) {
      suite += fmt::format("[[event]]\nframe = 0\nlight = \"{}\"\nfactor = {:.1f}\n", name, factor);
    }
    std::ofstream(file) << suite;
    return startOfSuite(file).settings.lights;
  };
  for (const LightFactors& lights :
       {LightFactors{}, LightFactors{{light(), 0.5}},
        LightFactors{{kAllLights, 4.0}, {light(), 0.5}}, LightFactors{{kAllLights, 0.0}}})
    EXPECT_EQ(again(lights), lights);
}

// All lights off, then one on: a suite's events that no product of factors can express.
TEST_F(ViewLightsTest, OffByASuiteButOneAreOffByThemselves) {
  const Scene scene = cornellBox().scene->source();
  const LightFactors lights = ownLights({{kAllLights, 0.0}, {light(), 0.25}}, scene);
  EXPECT_EQ(absoluteLights(lights).back(), (std::pair<std::string, double>(light(), 0.25)));
  for (const auto& [name, factor] : lights) EXPECT_NE(name, kAllLights) << factor;
  EXPECT_EQ(lights.size(), lightNames(scene).size());
}

// A history is not told of a change of the light; a method without a history is not affected.
TEST_F(ViewLightsTest, HistoriesThatGoOnAreSaid) {
  LiveView view = open();
  view.renderFrames();
  EXPECT_FALSE(view.hasOldLight(0));
  view.apply(SetLight{kAllLights, 2.0});
  view.renderFrames();
  EXPECT_TRUE(view.hasOldLight(0));
  EXPECT_FALSE(view.hasOldLight(1)) << "path has no history";
  view.apply(SetParameter{0, "confidence_cap", ParameterValue(int64_t{8})});
  EXPECT_TRUE(view.hasOldLight(0));
  view.apply(Restart{});
  EXPECT_FALSE(view.hasOldLight(0));
  view.renderFrames();
  EXPECT_FALSE(view.hasOldLight(0));
}

}  // namespace
}  // namespace restlab::view_test
