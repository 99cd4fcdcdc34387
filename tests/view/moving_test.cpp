// Frames while a hand moves the camera, and panes that are not seen.
#include <algorithm>
#include <atomic>
#include <fstream>

#include "experiments/view/measured_rows.h"
#include "experiments/view/moving_size.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

using Clock = MovingSize::Clock;

Clock::time_point atSecond(double seconds) {
  return Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(100.0 + seconds)));
}

MoveCamera movedBy(const LiveView& view, double metres) {
  SceneCamera camera = view.camera();
  camera.cameraToWorld[3].x += metres;
  MoveCamera move;
  for (int i = 0; i < 16; ++i) move.toWorld[size_t(i)] = camera.cameraToWorld[i / 4][i % 4];
  return move;
}

std::vector<SessionConfig> twoPanes(uint32_t width = 64, uint32_t height = 48) {
  std::vector<SessionConfig> panes = {smallPane("restir_gi"), smallPane("path", "accumulate")};
  for (SessionConfig& pane : panes) {
    pane.width = width;
    pane.height = height;
  }
  return panes;
}

TEST(MovingSizes, FollowTheTimeOfFrames) {
  MovingSize size;
  EXPECT_EQ(size.divisor(atSecond(0)), 1u) << "nothing moves";
  size.rendered(1, 0.12);
  size.move(atSecond(0));
  EXPECT_EQ(size.divisor(atSecond(0.01)), 2u) << "a quarter of 0.12 s is below 0.04 s";
  EXPECT_DOUBLE_EQ(size.roundS(2), 0.03);
  size.rendered(2, 0.07);
  EXPECT_EQ(size.roundS(2), 0.07);
  EXPECT_EQ(size.divisor(atSecond(0.1)), 2u);
  size.move(atSecond(0.15));
  size.rendered(2, 0.11);
  EXPECT_EQ(size.divisor(atSecond(0.2)), 4u) << "the frames were too slow";
  size.rendered(4, 0.5);
  size.rendered(8, 0.5);
  EXPECT_EQ(size.divisor(atSecond(0.2)), 8u) << "never smaller";
  EXPECT_EQ(size.divisor(atSecond(0.4)), 1u) << "the hand rests";
  size.rendered(1, 0.03);
  size.move(atSecond(1));
  EXPECT_EQ(size.divisor(atSecond(1)), 1u) << "fast enough as it is";
  size.rendered(1, 10.0);
  size.move(atSecond(2));
  EXPECT_EQ(size.divisor(atSecond(2)), 8u);
  size.setAdaptive(false);
  EXPECT_EQ(size.divisor(atSecond(2)), 1u);
}

// Smaller frames are those of a session of that size; the history of whole frames goes on as if
// they had not been.
TEST(MovingFrames, HaveHistoriesOfTheirOwn) {
  const std::vector<SessionConfig> panes = twoPanes();
  LiveView view(cornellBox(), panes, {});
  Session whole(cornellBox().scene, panes[0]);
  view.renderFrames();
  view.renderFrames();
  whole.frames(2);
  SessionConfig half = panes[0];
  half.width /= 2;
  half.height /= 2;
  Session moving(cornellBox().scene, half);
  for (int frame = 1; frame <= 3; ++frame) {
    view.apply(movedBy(view, 0.05));
    view.setDivisor(2);
    ASSERT_TRUE(view.renderFrames());
    EXPECT_TRUE(view.isMoving(0));
    moving.setCamera(view.camera());
    moving.frame();
    EXPECT_EQ(view.picture(0)->width, 32u);
    EXPECT_EQ(view.picture(0)->pixels, moving.radiance().pixels) << frame;
    EXPECT_EQ(view.frames(0), uint64_t(frame));
    EXPECT_EQ(view.epochOf(0), view.epoch());
  }
  view.setDivisor(1);
  ASSERT_TRUE(view.renderFrames());
  whole.setCamera(view.camera());
  whole.frame();
  EXPECT_FALSE(view.isMoving(0));
  EXPECT_EQ(view.picture(0)->pixels, whole.radiance().pixels);
  EXPECT_EQ(view.frames(0), 3u);

  view.setDivisor(4);
  view.renderFrames();
  view.apply(SetParameter{0, "confidence_cap", int64_t(8)});
  EXPECT_EQ(view.divisor(), 1u) << "another change ends a motion";
  EXPECT_EQ(view.epochOf(1), view.epoch() - 1) << "the whole frame from before the motion";
  view.setDivisor(1000);
  EXPECT_EQ(view.divisor(), 48u / LiveView::kLeastMovingSide);
}

TEST(MovingFrames, UnseenPanesRenderNothing) {
  LiveView view(cornellBox(), twoPanes(), {});
  view.setSeen(1, false);
  view.renderFrames();
  EXPECT_EQ(view.frames(0), 1u);
  EXPECT_EQ(view.frames(1), 0u);
  EXPECT_FALSE(view.renderFirstFrames());
  view.setSeen(0, false);
  EXPECT_FALSE(view.rendersAny());
  view.setSeen(1, true);
  EXPECT_TRUE(view.renderFirstFrames());
  EXPECT_EQ(view.frames(0), 1u);
  EXPECT_EQ(view.frames(1), 1u);
}

TEST(MovingFrames, AChangeOfOnePaneLeavesTheNumbersOfTheOther) {
  LiveView view(cornellBox(), twoPanes(), {});
  while (!view.reference().hasImage()) view.refineReference();
  for (int i = 0; i < 3; ++i) view.renderFrames();
  const uint64_t before = view.epoch();
  view.apply(SetParameter{0, "confidence_cap", int64_t(8)});
  EXPECT_EQ(view.error(0).frames(), 0u);
  EXPECT_EQ(view.error(1).frames(), 3u);
  EXPECT_EQ(view.begun(0), view.epoch());
  EXPECT_EQ(view.begun(1), before);
  EXPECT_EQ(view.pictureBegun(), before);
  EXPECT_EQ(view.age(0), 0u);
  EXPECT_EQ(view.age(1), 3u);
  view.apply(SetTransport{"max_bounces", int64_t(1)});
  EXPECT_EQ(view.error(1).frames(), 0u) << "another picture is one of both";
  EXPECT_EQ(view.pictureBegun(), view.epoch());
}

// The number is for people, but it must rise from 0 to nearly 1.
TEST(MovingFrames, TellHowFarTheyAre) {
  LiveView view(cornellBox(), twoPanes(), {});
  std::vector<double> seen[2];
  view.renderFrames([&] {  // panes have one thread each
    const auto [pane, fraction] = view.progress();
    seen[pane].push_back(fraction);
    return false;
  });
  for (const std::vector<double>& fractions : seen) {
    ASSERT_GT(fractions.size(), 5u);
    EXPECT_EQ(fractions.front(), 0.0);
    EXPECT_GT(fractions.back(), 0.9);
    EXPECT_LE(fractions.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  }
}

using MovingLoop = ViewLoopTest;

// A probe that is asked while the view moves is answered for the whole frame after it.
TEST_F(MovingLoop, FliesWithSmallerFramesAndRestsWithWholeOnes) {
  start(settingsOf(prepareScene(facts_.request), twoPanes(256, 192)));
  Page page(url());
  Json state = page.waitFor("state");
  EXPECT_TRUE(state["adaptive"].get<bool>());
  page.waitForImage([](const ShownImage& image) { return image.header.slot == 1; });
  Json toWorld = state["camera"]["to_world"];
  const auto move = [&] {
    toWorld[12] = toWorld[12].get<double>() + 0.01;
    page.say({{"do", "camera"}, {"to_world", toWorld}});
    state =
        page.waitFor("state", [&](const Json& s) { return s["camera"]["to_world"] == toWorld; });
  };
  move();
  for (int pane : {0, 1}) page.say({{"do", "probe"}, {"pane", pane}, {"x", 200}, {"y", 100}});
  // Without a hand that moves on, the frames have the whole size again.
  for (int pane : {0, 1}) {
    const Json answer = page.waitFor("probe", [&](const Json& a) { return a["pane"] == pane; });
    EXPECT_EQ(answer["epoch"], state["epoch"]);
  }
  page.waitForImage([&](const ShownImage& image) {
    return image.header.slot == 0 && image.header.epoch == state["epoch"] &&
           image.header.width == 256;
  });
  page.say({{"do", "look"}, {"on", true}, {"panes", {1}}});
  page.waitFor("numbers", [](const Json& n) { return !n["panes"][0]["seen"].get<bool>(); });
  page.say({{"do", "adaptive"}, {"on", false}});
  page.waitFor("state", [](const Json& s) { return !s["adaptive"].get<bool>(); });
  move();
  page.waitForImage([&](const ShownImage& image) {
    EXPECT_EQ(image.header.width, 256u);
    return image.header.slot == 1 && image.header.epoch == state["epoch"];
  });
}

// Flying while panes are paused shows the new view, and pauses again.
TEST_F(MovingLoop, PausedPanesShowAMovedCamera) {
  start();
  Page page(url());
  // The image may have come before the state.
  const auto expectImage = [&](uint32_t slot, uint64_t epoch) {
    const auto held = page.images().find(slot);
    if (held != page.images().end() && held->second.header.epoch == epoch) return;
    page.waitForImage([&](const ShownImage& image) {
      return image.header.slot == slot && image.header.epoch == epoch;
    });
  };
  page.say({{"do", "pause"}, {"on", true}});
  const Json state = page.waitFor("state", [](const Json& s) { return s["paused"]; });
  Json toWorld = state["camera"]["to_world"];
  toWorld[12] = toWorld[12].get<double>() + 0.1;
  page.say({{"do", "camera"}, {"to_world", toWorld}});
  const Json moved =
      page.waitFor("state", [&](const Json& s) { return s["camera"]["to_world"] == toWorld; });
  expectImage(1, moved["epoch"]);
  const Json numbers =
      page.waitFor("numbers", [](const Json& n) { return n["reference"]["spp"] >= 4; });
  EXPECT_LE(numbers["panes"][0]["age"], 1);
  // A pane that comes into view later shows the new camera, too.
  page.say({{"do", "look"}, {"on", true}, {"panes", {0}}});
  page.waitFor("numbers", [](const Json& n) { return !n["panes"][1]["seen"].get<bool>(); });
  toWorld[12] = toWorld[12].get<double>() + 0.1;
  page.say({{"do", "camera"}, {"to_world", toWorld}});
  const Json again =
      page.waitFor("state", [&](const Json& s) { return s["camera"]["to_world"] == toWorld; });
  expectImage(0, again["epoch"]);
  page.say({{"do", "look"}, {"on", true}, {"panes", {1}}});
  expectImage(1, again["epoch"]);
}

using RowsOfRuns = TemporaryFolder;

TEST_F(RowsOfRuns, AreMeansOfWholeLines) {
  const std::filesystem::path file = folder() / "results.jsonl";
  const auto add = [&](const std::string& text) { std::ofstream(file, std::ios::app) << text; };
  const auto line = [](const char* method, double mse, double ms) {
    return Json{{"kind", "run"},       {"method", method},
                {"mse", mse},          {"relmse_e1e-2", 2.0 * mse},
                {"energy_ratio", 1.0}, {"time_ms", {{"median", ms}}}}
               .dump() +
           "\n";
  };
  add(line("old", 1.0, 1.0));
  MeasuredRows rows;
  rows.follow(file);
  EXPECT_FALSE(rows.poll()) << "its lines are of an earlier run";
  const std::string next = line("path", 3.0, 10.0);
  add(line("path", 1.0, 8.0) + "no JSON\n" + R"({"kind": "checkpoint", "method": "x", "mse": 3})" +
      "\n" + line("gi", 0.5, 9.0) + next.substr(0, 20));
  EXPECT_TRUE(rows.poll());
  EXPECT_EQ(rows.rows().at(0).runs, 1u);
  EXPECT_FALSE(rows.poll()) << "half a line";
  add(next.substr(20));
  EXPECT_TRUE(rows.poll());
  ASSERT_EQ(rows.rows().size(), 2u);
  const MeasuredRow& path = rows.rows()[0];
  EXPECT_EQ(path.method, "path");
  EXPECT_EQ(path.runs, 2u);
  EXPECT_DOUBLE_EQ(path.mse, 2.0);
  EXPECT_DOUBLE_EQ(path.relmse, 4.0);
  EXPECT_DOUBLE_EQ(path.timeMs, 9.0);
  EXPECT_EQ(rows.rows()[1].runs, 1u);
  for (size_t i = 0; i < 2 * MeasuredRows::kMostRows; ++i)
    add(line(std::to_string(i).c_str(), 1.0, 1.0));
  rows.poll();
  EXPECT_EQ(rows.rows().size(), MeasuredRows::kMostRows);
}

}  // namespace
}  // namespace restlab::view_test
