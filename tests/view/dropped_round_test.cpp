// Rounds of frames that a page's command stops in the middle: they leave no trace.
#include <atomic>
#include <functional>
#include <memory>

#include "core/image/metrics/metrics.h"
#include "experiments/runner/run/experiment.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

// Returns a check that is true from its call number `look` on.
LiveView::StopCheck stopAt(int look) {
  return [left = std::make_shared<std::atomic<int>>(look)] { return left->fetch_sub(1) <= 0; };
}

MoveCamera moveOf(SceneCamera camera, double metres) {
  camera.cameraToWorld[3].x += metres;
  MoveCamera move;
  for (int i = 0; i < 16; ++i) move.toWorld[size_t(i)] = camera.cameraToWorld[i / 4][i % 4];
  return move;
}

int looksOf(LiveView& view) {
  std::atomic<int> looks = 0;
  EXPECT_TRUE(view.renderFrames([&] {
    ++looks;
    return false;
  }));
  return looks;
}

// Images, frame counts and errors match sessions of `run` exactly: in both panes, if dropped in the
// first one or in the second one, before and after a move.
TEST(DroppedRounds, EnterNoHistoryAndNoNumber) {
  const std::vector<SessionConfig> panes = {smallPane("restir_gi"),
                                            smallPane("path", "accumulate")};
  LiveView view(cornellBox(), panes, {});
  for (int sample = 0; sample < 6; ++sample) {
    EXPECT_FALSE(view.refineReference(stopAt(sample % 2)));
    EXPECT_TRUE(view.refineReference());
  }
  LiveView undisturbed(cornellBox(), panes, {});
  for (int sample = 0; sample < 6; ++sample) undisturbed.refineReference();
  EXPECT_EQ(view.reference().mean().pixels, undisturbed.reference().mean().pixels);
  Reference reference;
  reference.mean = view.reference().mean();
  reference.half0 = view.reference().half0();
  reference.half1 = view.reference().half1();

  Session gi(cornellBox().scene, panes[0]), path(cornellBox().scene, panes[1]);
  const auto expectFrame = [&](uint64_t frame, bool isMeasured) {
    for (size_t i = 0; i < 2; ++i) {
      Session& session = i == 0 ? gi : path;
      const FrameStats stats = session.frame();
      EXPECT_EQ(view.frames(i), frame + 1);
      EXPECT_EQ(view.session(i).radiance().pixels, session.radiance().pixels) << i;
      EXPECT_EQ(view.stats(i).raysPath, stats.raysPath);
      if (!isMeasured) continue;
      EXPECT_EQ(view.error(i).frames(), frame + 1);
      EXPECT_EQ(view.error(i).lastMse(),
                measureFrame(session.radiance(), reference, uint32_t(frame), {}).mse);
    }
  };
  const int looks = looksOf(view);
  expectFrame(0, true);
  ASSERT_GT(looks, 10);
  int dropped = 0;
  const auto drop = [&](LiveView& from, int look) {
    const double ms = from.stats(0).timeMs;
    const uint64_t age = from.age(0);
    EXPECT_FALSE(from.renderFrames(stopAt(look))) << look;
    EXPECT_EQ(from.stats(0).timeMs, ms);
    EXPECT_EQ(from.age(0), age);
    ++dropped;
  };
  for (uint64_t frame = 1; frame < 4; ++frame) {
    // Some passes do not run while the view is still, so there are fewer checks.
    for (const int look : {0, 1, 3, 5, 7}) drop(view, look);
    EXPECT_TRUE(view.renderFrames());
    expectFrame(frame, true);
  }
  EXPECT_EQ(view.age(0), 4u);
  for (uint64_t frame = 4; frame < 7; ++frame) {
    drop(view, 2);
    SceneCamera camera = cornellBox().scene->source().cameras[0];
    const MoveCamera move = moveOf(camera, 0.1 * double(frame - 3));
    camera.cameraToWorld[3].x = move.toWorld[12];
    view.apply(move);
    for (Session* session : {&gi, &path}) session->setCamera(camera);
    for (int look = 0; look < looks; look += 3) drop(view, look);
    EXPECT_TRUE(view.renderFrames());
    expectFrame(frame, false);
  }
  EXPECT_GT(dropped, 20);
}

class DroppedRoundTest : public ViewLoopTest {
 protected:
  // At this size a round takes minutes.
  static constexpr int kSide = 1024;
  void SetUp() override {
    ViewLoopTest::SetUp();
    facts_.request.scene = "furnace";
    std::vector<SessionConfig> panes = {smallPane("path"), smallPane("path", "accumulate")};
    for (SessionConfig& pane : panes) pane.maxBounces = 1024;
    start(settingsOf(prepareScene(facts_.request), panes));
  }
};

TEST_F(DroppedRoundTest, CommandsDoNotWaitForIt) {
  Page page(url());
  page.waitFor("numbers", [](const Json& n) { return n["age"] >= 1; });
  page.say({{"do", "adaptive"}, {"on", false}});
  page.say({{"do", "resolution"}, {"width", kSide}, {"height", kSide}});
  const Json state = page.waitFor("state", [](const Json& s) { return s["width"] == kSide; });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  Json matrix = state["camera"]["to_world"];
  matrix[12] = matrix[12].get<double>() + 0.125;
  page.say({{"do", "camera"}, {"to_world", matrix}});
  page.waitFor("state", [&](const Json& s) { return s["camera"]["to_world"] == matrix; });
  // The next round is waited for, but not forever.
  const auto begun = std::chrono::steady_clock::now();
  page.say({{"do", "resolution"}, {"width", 24}, {"height", 16}});
  page.waitFor("state", [](const Json& s) { return s["width"] == 24; });
  EXPECT_GT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(2));
  page.waitFor("numbers", [](const Json& n) { return n["panes"][0]["frame"] >= 2; });
}

TEST_F(DroppedRoundTest, NorDoesTheEnd) {
  Page page(url());
  page.waitFor("numbers", [](const Json& n) { return n["age"] >= 1; });
  page.say({{"do", "resolution"}, {"width", kSide}, {"height", kSide}});
  page.waitFor("state", [](const Json& s) { return s["width"] == kSide; });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto begun = std::chrono::steady_clock::now();
  stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
  EXPECT_EQ(view_->frames(0), 0u) << "no frame has half of its pixels";
}

}  // namespace
}  // namespace restlab::view_test
