// Tests of the viewer by its messages to pages, their commands, and mistakes that must not stop it.
#include "experiments/view/view_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "experiments/runner/registries/registries.h"
#include "experiments/runner/suite/suite.h"
#include "experiments/view/probe_values.h"
#include "experiments/view/view_session.h"
#include "experiments/view/view_session_file.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

Json parameterNamed(const Json& state, int pane, const std::string& name) {
  for (const Json& parameter : state["panes"][size_t(pane)]["parameters"])
    if (parameter["name"] == name) return parameter;
  return nullptr;
}

TEST_F(ViewLoopTest, SaysHelloThenWhatIsSet) {
  start();
  Page page(url());
  const Json hello = page.next();
  EXPECT_EQ(hello["say"], "hello");
  EXPECT_EQ(hello["scene"]["name"], "cornell-box");
  EXPECT_EQ(hello["scene"]["cameras"][0]["to_world"].size(), 16u);
  EXPECT_FALSE(hello["scene"]["lights"].empty());
  EXPECT_EQ(hello["integrators"], Json(integratorsJson()));
  EXPECT_EQ(hello["denoisers"], Json(denoisersJson()));
  EXPECT_EQ(hello["settings"], Json({"integrator", "mode", "cache", "backend", "denoiser"}));
  EXPECT_GT(hello["exposure"].get<double>(), 0.0);
  EXPECT_EQ(hello["faults"], Json({"nonfinite", "dropped_weights"}));
  const Json state = page.next();
  EXPECT_EQ(state["say"], "state");
  EXPECT_EQ(state["panes"][0]["integrator"], "restir_gi");
  EXPECT_EQ(state["panes"][1]["denoiser"], "accumulate");
  EXPECT_EQ(state["width"], 24);
  EXPECT_EQ(state["camera"]["to_world"], hello["scene"]["cameras"][0]["to_world"]);
  EXPECT_FALSE(state["can_undo"].get<bool>());
  const Json cap = parameterNamed(state, 0, "confidence_cap");
  EXPECT_EQ(cap["value"], cap["default"]);
  EXPECT_EQ(cap["part"], "reuse");
  EXPECT_FALSE(cap["is_set"].get<bool>());
  for (const char* key : {"range", "help", "source"}) EXPECT_TRUE(cap.contains(key)) << key;
}

TEST_F(ViewLoopTest, ShowsWhatSessionsRender) {
  start();
  Page page(url());
  for (uint32_t slot : {0u, 1u}) {
    page.waitForImage([&](const ShownImage& image) {
      return image.header.slot == slot && image.header.frame >= 3;
    });
  }
  const PreparedScene box = prepareScene(facts_.request);
  Session gi(box.scene, smallPane("restir_gi")), path(box.scene, smallPane("path", "accumulate"));
  for (uint32_t slot : {0u, 1u}) {
    const ShownImage& image = page.images().at(slot);
    Session& session = slot == 0 ? gi : path;
    session.frames(image.header.frame);
    ASSERT_EQ(image.header.format, PixelFormat::floats);
    ASSERT_EQ(image.pixels.size(), 24u * 16u * 12u);
    EXPECT_EQ(
        std::memcmp(image.pixels.data(), session.radiance().pixels.data(), image.pixels.size()), 0)
        << "pane " << slot << ", frame " << image.header.frame;
  }
}

TEST_F(ViewLoopTest, NumbersBeginAnewWithAParameter) {
  start();
  Page page(url());
  const Json before = page.waitFor(
      "numbers", [](const Json& numbers) { return numbers["panes"][0]["frames_measured"] > 2; });
  EXPECT_TRUE(before["panes"][0]["mse"]["value"].is_number());
  EXPECT_TRUE(before["panes"][0]["mse"]["lo"].is_null()) << "few frames say little";
  EXPECT_TRUE(before["panes"][0]["relmse"]["value"].is_number());
  EXPECT_GT(before["reference"]["spp"], 1);
  page.say({{"do", "parameter"}, {"pane", 0}, {"name", "confidence_cap"}, {"value", 8}});
  const Json state = page.waitFor("state", [](const Json& s) { return s["can_undo"]; });
  EXPECT_GT(state["epoch"], before["epoch"]);
  EXPECT_EQ(state["undo_text"], "A: confidence_cap = 8");
  EXPECT_EQ(parameterNamed(state, 0, "confidence_cap")["value"], 8);
  EXPECT_TRUE(parameterNamed(state, 0, "confidence_cap")["is_set"].get<bool>());
  const Json after = page.waitFor(
      "numbers", [&](const Json& numbers) { return numbers["epoch"] == state["epoch"]; });
  EXPECT_LT(after["age"], before["age"]);
  EXPECT_LE(after["panes"][0]["frames_measured"], after["age"]);
  EXPECT_GE(after["reference"]["spp"], before["reference"]["spp"]) << "it is of the same picture";
  page.waitForImage([](const ShownImage& image) { return image.header.slot == kReferenceSlot; });
}

TEST_F(ViewLoopTest, PausedPanesStandAndTheReferenceGoesOn) {
  start();
  Page page(url());
  page.say({{"do", "pause"}, {"on", true}});
  page.waitFor("state", [](const Json& state) { return state["paused"]; });
  const Json first =
      page.waitFor("numbers", [](const Json& n) { return n["reference"]["spp"] >= 4; });
  const Json later = page.waitFor(
      "numbers", [&](const Json& n) { return n["reference"]["spp"] > first["reference"]["spp"]; });
  EXPECT_EQ(later["age"], first["age"]);
  page.say({{"do", "layer"}, {"pane", 0}, {"name", "age"}});
  page.waitForImage([](const ShownImage& i) { return i.header.slot == kFirstLayerSlot; });
  page.say({{"do", "pause"}, {"on", false}});
  page.waitFor("numbers", [&](const Json& n) { return n["age"] > later["age"]; });
}

// A pane whose method was changed shows its first frame; the other pane stays as it is.
TEST_F(ViewLoopTest, PausedPanesShowAChangeOfTheirMethod) {
  start();
  Page page(url());
  page.say({{"do", "pause"}, {"on", true}});
  page.waitFor("state", [](const Json& state) { return state["paused"]; });
  page.say({{"do", "set"}, {"pane", 1}, {"key", "denoiser"}, {"value", "none"}});
  const Json state = page.waitFor("state", [](const Json& s) { return s["can_undo"]; });
  page.waitForImage([&](const ShownImage& image) {
    return image.header.slot == 1 && image.header.epoch == state["epoch"];
  });
  const Json numbers =
      page.waitFor("numbers", [&](const Json& n) { return n["epoch"] == state["epoch"]; });
  EXPECT_EQ(numbers["panes"][1]["frame"], 1);
  EXPECT_EQ(numbers["panes"][1]["age"], 1) << "no round was rendered";
}

TEST_F(ViewLoopTest, TellsEveryPageOfAChange) {
  start();
  Page first(url()), second(url());
  first.waitFor("state");
  second.waitFor("state");
  first.say({{"do", "copy"}, {"from", 1}, {"to", 0}});
  for (Page* page : {&first, &second}) {
    const Json state = page->waitFor("state", [](const Json& s) { return s["can_undo"]; });
    EXPECT_EQ(state["panes"][0]["integrator"], "path");
    EXPECT_EQ(state["panes"][0]["denoiser"], "accumulate");
  }
  // A page that reconnects finds the settings unchanged.
  first.close();
  second.close();
  Page third(url());
  EXPECT_EQ(third.waitFor("state")["panes"][0]["integrator"], "path");
}

TEST_F(ViewLoopTest, RefusesInOneLineAndChangesNothing) {
  start();
  Page page(url());
  const Json before = page.waitFor("state");
  const std::pair<Json, const char*> cases[] = {
      {{{"do", "set"}, {"pane", 0}, {"key", "integrator"}, {"value", "pth"}}, "'path'"},
      {{{"do", "parameter"}, {"pane", 0}, {"name", "confidence_cap"}, {"value", -1}}, "between"},
      {{{"do", "light"}, {"name", "lampe"}, {"factor", 2}}, "lampe"},
      {{{"do", "undo"}}, "nothing was changed"},
      {{{"do", "redo"}}, "nothing was undone"},
      {{{"do", "probe"}, {"pane", 0}, {"x", 24}, {"y", 0}}, "24x16"},
      {{{"do", "dance"}}, "unknown"},
  };
  for (const auto& [command, says] : cases) {
    page.say(command);
    const Json error = page.waitFor("error");
    EXPECT_NE(error["text"].get<std::string>().find(says), std::string::npos) << error;
    EXPECT_EQ(error["command"], command.dump());
  }
  page.say({{"do", "pause"}, {"on", true}});
  Json after = page.waitFor("state");
  after["paused"] = false;
  EXPECT_EQ(after, before);
}

TEST_F(ViewLoopTest, ProbesAPixel) {
  // Probe the lamp's brightest pixel: its value is unique.
  Session once(prepareScene(facts_.request).scene, smallPane("restir_gi"));
  once.frame();
  const std::vector<glm::vec3>& pixels = once.radiance().pixels;
  const auto brightest = std::max_element(pixels.begin(), pixels.end(),
                                          [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto index = uint32_t(brightest - pixels.begin());
  const uint32_t x = index % 24, y = index / 24;
  start();
  Page page(url());
  page.waitFor("numbers", [](const Json& n) { return n["age"] >= 2; });
  page.say({{"do", "pause"}, {"on", true}});
  page.waitFor("state", [](const Json& state) { return state["paused"]; });
  page.say({{"do", "probe"}, {"pane", 0}, {"x", x}, {"y", y}});
  const Json probe = page.waitFor("probe");
  EXPECT_EQ(probe["x"], x);
  ASSERT_FALSE(probe["values"].empty());
  for (const Json& value : probe["values"]) {
    if (value["name"] != "confidence") continue;
    EXPECT_EQ(value["unit"], "samples");
    EXPECT_GE(value["value"].get<double>(), 1.0);
  }
  // Values equal those of a session with as many frames, which is what `render --pixel` renders.
  Session again(prepareScene(facts_.request).scene, smallPane("restir_gi"));
  for (int frame = 0; frame < probe["frame"]; ++frame) again.frame();
  EXPECT_EQ(probe["values"], Json(probedValuesJson(again, x, y)));
  EXPECT_EQ(probe["donors"], Json(probedDonorsJson(again, x, y)));
  EXPECT_EQ(probe["donors"][0]["reuse"], "canonical");
  EXPECT_EQ(probe["path"], Json(probedPathJson(again, x, y)));
  EXPECT_EQ(probe["values"][0]["name"], "shaded radiance");
  const glm::vec3& shown = again.radiance().at(x, y);
  ASSERT_GT(shown.x, 0.0f);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(probe["values"][0]["value"][size_t(c)], shown[c], 1e-5 * shown[c]);
  const std::string command = probe["command"];
  EXPECT_EQ(command.rfind("restlab render cornell-box ", 0), 0u) << command;
  EXPECT_NE(
      command.find(fmt::format("--pixel {},{} --seed 1 --frame {}", x, y, probe["frame"].dump())),
      std::string::npos)
      << command;
  // A camera that was moved by hand has no command line.
  Json camera = page.waitFor("numbers");
  page.say({{"do", "camera"}, {"to_world", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1, 1, 3, 1}}});
  page.say({{"do", "probe"}, {"pane", 0}, {"x", x}, {"y", y}});
  EXPECT_EQ(page.waitFor("probe")["command"], "");
}

TEST_F(ViewLoopTest, GoesOnWhenAPageStopsReading) {
  start();
  Page deaf(url()), page(url());
  deaf.waitFor("state");
  // 70 KB per round: more than the connection can buffer.
  page.say({{"do", "resolution"}, {"width", 64}, {"height", 48}});
  page.waitFor("numbers", [](const Json& n) { return n["age"].get<int>() > 500; });
  // The page is still connected: only the newest numbers and images wait for it.
  deaf.say({{"do", "pause"}, {"on", true}});
  page.waitFor("state", [](const Json& state) { return state["paused"]; });
}

TEST_F(ViewLoopTest, RoundsLargeImagesOfWhatMoves) {
  start();
  Page page(url());
  page.say({{"do", "resolution"}, {"width", 256}, {"height", 192}});
  const auto isOf = [](PixelFormat format) {
    return [format](const ShownImage& image) {
      return image.header.slot == 0 && image.header.width == 256 && image.header.format == format;
    };
  };
  page.waitForImage(isOf(PixelFormat::halves));
  page.say({{"do", "pause"}, {"on", true}});
  page.waitForImage(isOf(PixelFormat::floats));
  EXPECT_EQ(page.images().at(0).pixels.size(), 256u * 192u * 12u);
}

TEST_F(ViewLoopTest, SavesWhatItShows) {
  start();
  Page page(url());
  page.waitFor("state");
  const double c = std::cos(0.3), s = std::sin(0.3);
  page.say({{"do", "camera"},
            {"to_world", {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.125, 1.0625, 3.1, 1}},
            {"yfov", 0.7}});
  page.say({{"do", "set"}, {"pane", 0}, {"key", "mode"}, {"value", "biased"}});
  page.say({{"do", "set"}, {"pane", 0}, {"key", "cache"}, {"value", "voxel"}});
  page.say({{"do", "parameter"}, {"pane", 0}, {"name", "confidence_cap"}, {"value", 9}});
  page.say({{"do", "parameter"}, {"pane", 1}, {"name", "accumulate_cap"}, {"value", 5}});
  page.say({{"do", "light"}, {"name", "all"}, {"factor", 0.5}});
  page.say({{"do", "resolution"}, {"width", 20}, {"height", 12}});
  page.say({{"do", "save"}, {"name", "mine"}});
  EXPECT_EQ(page.waitFor("saved")["name"], "mine.toml");
  page.say({{"do", "save"}});
  const Json saved = page.waitFor("saved");
  EXPECT_EQ(saved["name"], "session.toml");
  page.say({{"do", "save"}});
  EXPECT_EQ(page.waitFor("saved")["name"], "session-2.toml") << "no file is written over";
  stop();
  const ViewStart start = startOfSuite(folder() / "session.toml");
  EXPECT_EQ(start.request.scene, "cornell-box");
  ViewSettings before = view_->settings();
  const SceneCamera &was = before.camera, &is = start.settings.camera;
  for (int i = 0; i < 16; ++i)
    EXPECT_NEAR(was.cameraToWorld[i / 4][i % 4], is.cameraToWorld[i / 4][i % 4], 1e-12) << i;
  EXPECT_NEAR(was.yfov, is.yfov, 1e-12);
  before.camera = is;
  EXPECT_TRUE(isSame(before, start.settings)) << saved["toml"].get<std::string>();
  // Saving the opened session again gives an identical file.
  const LiveView again(start.prepared, start.settings, {});
  const std::string name = loadSuite(folder() / "session.toml", {}).name;
  EXPECT_EQ(name.rfind("cornell-box-20", 0), 0u) << "of the scene and the time: " << name;
  EXPECT_EQ(sessionToml({start.request, 1, ""}, again, name), saved["toml"].get<std::string>());
  EXPECT_EQ(loadSuite(folder() / "mine.toml", {}).name, "mine");
}

TEST_F(ViewLoopTest, SavesTwoOfTheSame) {
  ViewSettings settings =
      settingsOf(prepareScene(facts_.request), {smallPane("restir_gi"), smallPane("restir_gi")});
  const auto reopened = [&] {
    const LiveView view(prepareScene(facts_.request), settings, {});
    std::ofstream(folder() / "two.toml") << sessionToml(facts_, view, "two");
    return startOfSuite(folder() / "two.toml").settings;
  };
  EXPECT_TRUE(isSame(reopened(), settings));
  const LiveView view(prepareScene(facts_.request), settings, {});
  const std::string text = sessionToml(facts_, view, "two");
  EXPECT_NE(text.find("baseline = \"restir_gi (unbiased) B\""), std::string::npos) << text;
}

Json randomCommand(std::mt19937& random) {
  const auto below = [&](size_t n) { return random() % n; };
  const auto pick = [&](const std::vector<std::string>& all) { return all[below(all.size())]; };
  const int pane = int(below(2));
  switch (below(15)) {
    case 0:
      return {{"do", "set"},
              {"pane", pane},
              {"key", "integrator"},
              {"value", pick({"path", "restir_gi", "template", "pth"})}};
    case 1:
      return {{"do", "set"},
              {"pane", pane},
              {"key", pick({"mode", "cache"})},
              {"value", pick({"biased", "unbiased", "voxel", "pixel", "surflet"})}};
    case 2:
      return {{"do", "set"},
              {"pane", pane},
              {"key", "denoiser"},
              {"value", pick({"none", "accumulate", "svgf", "atrous", "firefly"})}};
    case 3:
      return {{"do", "parameter"},
              {"pane", pane},
              {"name", pick({"confidence_cap", "accumulate_cap", "spatial_radius", "secondary"})},
              {"value", pick({"3", "8", "cache"}) == "8" ? Json(8) : Json(nullptr)}};
    case 4:
      return {{"do", "camera"},
              {"to_world", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.01 * int(below(50)), 1, 3, 1}}};
    case 5:
      return {{"do", "resolution"}, {"width", 1 + below(32)}, {"height", 1 + below(24)}};
    case 6:
      return {{"do", "light"},
              {"name", pick({"all", "Light", "sun"})},
              {"factor", 0.5 * double(below(4))}};
    case 7:
      return {{"do", "layer"}, {"pane", pane}, {"name", pick({"", "age", "depth", "motion"})}};
    case 8:
      return {{"do", "probe"}, {"pane", pane}, {"x", below(32)}, {"y", below(24)}};
    case 9:
      return {{"do", "pause"}, {"on", below(4) == 0}};
    case 10:
      return {{"do", pick({"restart", "undo", "redo"})}};
    case 11:
      return {{"do", "copy"}, {"from", pane}, {"to", below(3)}};
    case 12:
      return {{"do", pick({"undo", "redo", "dance", ""})}};
    case 13:
      return below(2) == 0
                 ? Json{{"do", "adaptive"}, {"on", below(4) > 0}}
                 : Json{{"do", "look"}, {"on", below(4) > 0}, {"panes", {pane, below(70)}}};
    default:
      return below(2) == 0 ? Json::array() : Json{{"do", "camera"}, {"to_world", {1, 2}}};
  }
}

TEST_F(ViewLoopTest, LivesThroughRandomCommands) {
  start();
  Page page(url());
  page.waitFor("state");
  std::mt19937 random(20);
  for (int i = 0; i < 500; ++i) {
    page.say(randomCommand(random));
    if (i % 10 == 9) {
      page.say({{"do", "pause"}, {"on", i % 20 == 9}});
      page.waitFor("state", [&](const Json& state) { return state["paused"] == (i % 20 == 9); });
    }
  }
  page.say({{"do", "restart"}});
  page.say({{"do", "look"}, {"on", true}});
  page.say({{"do", "pause"}, {"on", false}});
  page.waitFor("numbers", [](const Json& numbers) { return numbers["age"] > 3; });
}

}  // namespace
}  // namespace restlab::view_test
