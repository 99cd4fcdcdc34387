// Work of the viewer for its pages, and its rest while nobody looks.
#include <ctime>
#include <fstream>

#include "experiments/view/view_loop.h"
#include "experiments/view/view_session.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

using ViewPagesTest = ViewLoopTest;

TEST(PageEventsOfPages, AreBoundedInBytes) {
  PageEvents events;
  const std::string text(64 << 10, 'x');
  for (size_t i = 0; i < 100; ++i) events.add({PageEvent::Kind::said, 1, text});
  events.add({PageEvent::Kind::closed, 1, ""});
  EXPECT_TRUE(events.takeLost());
  const std::vector<PageEvent> taken = events.take({});
  EXPECT_EQ(taken.size(), PageEvents::kMostBytes / text.size() + 1);
  EXPECT_EQ(taken.back().kind, PageEvent::Kind::closed) << "pages that go are never lost";
  events.add({PageEvent::Kind::said, 1, text});
  EXPECT_FALSE(events.takeLost()) << "there is room again";
}

TEST_F(ViewPagesTest, TellsOfTheNewestFramesAndOfOldLight) {
  start();
  Page page(url());
  page.say({{"do", "light"}, {"name", "all"}, {"factor", 2}});
  const Json numbers = page.waitFor("numbers", [](const Json& n) {
    return n["panes"][0]["mse_newest"].is_number() && n["panes"][1]["old_light"] == true;
  });
  EXPECT_EQ(numbers["newest_frames"], RunningError::kNewest);
  EXPECT_GE(numbers["panes"][0]["frames_measured"], RunningError::kNewest);
  page.say({{"do", "restart"}});
  page.waitFor("numbers", [](const Json& n) { return n["panes"][1]["old_light"] == false; });
}

TEST_F(ViewPagesTest, SavesLightAsItIs) {
  start();
  Page page(url());
  const Json state = page.waitFor("state");
  const std::string light = state["lights"].back()["name"];
  page.say({{"do", "light"}, {"name", light}, {"factor", 0.5}});
  page.say({{"do", "light"}, {"name", "all"}, {"factor", 4}});
  page.say({{"do", "save"}});
  const auto file = folder() / "saved.toml";
  std::ofstream(file) << page.waitFor("saved")["toml"].get<std::string>();
  EXPECT_EQ(startOfSuite(file).settings.lights, (LightFactors{{"all", 4.0}, {light, 0.5}}));
}

// A hidden page causes no rendering, and is up to date when it becomes visible again.
TEST_F(ViewPagesTest, RestsWhileNobodyLooks) {
  start();
  Page hidden(url());
  hidden.waitFor("numbers", [](const Json& n) { return n["age"] >= 2; });
  hidden.say({{"do", "look"}, {"on", false}});
  hidden.say({{"do", "pause"}, {"on", false}});
  hidden.waitFor("state", [](const Json& state) { return state["paused"] == false; });
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_LT(double(std::clock() - before) / CLOCKS_PER_SEC, 0.2);
  // A hidden page is still told of changed settings.
  hidden.say({{"do", "layer"}, {"pane", 0}, {"name", "age"}});
  hidden.waitFor("state", [](const Json& state) { return state["can_undo"]; });
  hidden.say({{"do", "look"}, {"on", true}});
  const Json back = hidden.waitFor("numbers");
  hidden.waitFor("numbers", [&](const Json& n) { return n["age"] > back["age"]; });
  // The page is hidden while another one is visible: only the other one gets numbers.
  Page seen(url());
  hidden.say({{"do", "look"}, {"on", false}});
  hidden.say({{"do", "layer"}, {"pane", 0}, {"name", ""}});
  seen.waitFor("state", [](const Json& state) { return state["panes"][0]["layer"] == ""; });
  hidden.waitFor("state", [](const Json& state) { return state["panes"][0]["layer"] == ""; });
  seen.waitFor("numbers", [&](const Json& n) { return n["age"] > back["age"].get<int>() + 5; });
  hidden.say({{"do", "layer"}, {"pane", 0}, {"name", "age"}});
  for (Json text = hidden.next(); text["say"] != "state"; text = hidden.next())
    EXPECT_NE(text["say"], "numbers") << text;
  hidden.close();
  seen.waitFor("numbers", [&](const Json& n) { return n["age"] > back["age"].get<int>() + 10; });
}

// Rounding an ID would make it another ID.
TEST_F(ViewPagesTest, LayersOfNamesAreNeverRounded) {
  std::vector<SessionConfig> panes = {smallPane("restir_gi"), smallPane("path")};
  for (SessionConfig& pane : panes) {
    pane.width = 256;  // 512 KB are 43690 pixels
    pane.height = 180;
  }
  start(settingsOf(prepareScene(facts_.request), panes));
  Page page(url());
  page.say({{"do", "layer"}, {"pane", 0}, {"name", "object"}});
  page.say({{"do", "layer"}, {"pane", 1}, {"name", "depth"}});
  page.say({{"do", "restart"}});  // not still: large images are rounded
  page.waitForImage([](const ShownImage& image) {
    EXPECT_FALSE(image.header.slot == kFirstLayerSlot &&
                 image.header.format == PixelFormat::halves);
    return image.header.slot == kFirstLayerSlot + 1 && image.header.format == PixelFormat::halves;
  });
  page.waitForImage([](const ShownImage& image) { return image.header.slot == kFirstLayerSlot; });
}

}  // namespace
}  // namespace restlab::view_test
