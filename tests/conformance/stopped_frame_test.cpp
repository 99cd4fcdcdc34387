// Frames that are stopped in the middle, or taken back: as if they had never begun.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>

#include "core/backend/backend.h"
#include "core/frame/session.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

// Returns a check that is true from its call number `look` on.
std::function<bool()> stopAt(uint32_t look) {
  return [left = std::make_shared<std::atomic<int64_t>>(look)] { return left->fetch_sub(1) <= 0; };
}

SceneCamera cameraOf(const CompiledScene& scene, uint32_t step) {
  SceneCamera camera = scene.source().cameras.at(0);
  camera.cameraToWorld[3] += 0.02 * double(step) * camera.cameraToWorld[0];
  return camera;
}

void expectSame(const Session& a, const Session& b) {
  EXPECT_EQ(countDifferent(a.radiance(), b.radiance()), 0u);
  for (const LayerInfo* layer : findMethod(a.config()).layers())
    EXPECT_EQ(countDifferent(a.aov(layer->name), b.aov(layer->name)), 0u) << layer->name;
  const std::vector<ProbeValue> one = a.probe(20, 18), other = b.probe(20, 18);
  ASSERT_EQ(one.size(), other.size());
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].value, other[i].value) << one[i].name;
}

void expectSame(const FrameStats& a, const FrameStats& b) {
  EXPECT_EQ(a.raysPath, b.raysPath);
  EXPECT_EQ(a.raysShadow, b.raysShadow);
  EXPECT_EQ(a.health.counts, b.health.counts);
}

class StoppedFrames : public ::testing::TestWithParam<Variant> {};

// Runs still frames, then moves. Between them other frames are stopped early, late and in passes in
// between, with the camera before or after the move.
TEST_P(StoppedFrames, LeaveNoTrace) {
  const auto scene = bias::builtinScene("door-ajar");
  const SessionConfig config = configOf(GetParam());
  Session whole(scene, config), stopped(scene, config);
  uint32_t looks = 0;  // calls of the check in a whole frame
  const auto count = [&] {
    ++looks;
    return false;
  };
  // The first frame may do work for the scene.
  for (int frame = 0; frame < 2; ++frame) {
    looks = 0;
    ASSERT_TRUE(stopped.frameUnless(count));
    whole.frame();
    expectSame(stopped, whole);
  }
  ASSERT_GT(looks, 5u);
  uint32_t stops = 0;
  for (uint32_t frame = 1; frame < 9; ++frame) {
    SCOPED_TRACE(frame);
    const uint32_t step = frame < 5 ? 0 : frame - 4;
    for (const uint32_t at : {0u, looks / 3, looks * frame / 9, looks - 1}) {
      stopped.setCamera(cameraOf(*scene, at % 2 == 0 ? step : step + 3));
      if (stopped.frameUnless(stopAt(at))) {
        stopped.takeBack();  // had fewer passes, and was not stopped
        continue;
      }
      ++stops;
      EXPECT_FALSE(stopped.canTakeBack());
      if (at == 0) expectSame(stopped, whole);
    }
    for (Session* session : {&stopped, &whole}) session->setCamera(cameraOf(*scene, step));
    const auto stats = stopped.frameUnless([] { return false; });
    ASSERT_TRUE(stats);
    expectSame(*stats, whole.frame());
    expectSame(stopped, whole);
  }
  EXPECT_GE(stops, 16u);
}

INSTANTIATE_TEST_SUITE_P(Registry, StoppedFrames, ::testing::ValuesIn(byDay(allVariants())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, StoppedFrames, ::testing::ValuesIn(byNight(allVariants())),
                         VariantName());

// Several threads do not stop at the same time; devices are tested, too.
TEST(StoppedFrame, IsWholeOrNotThere) {
  const auto scene = bias::builtinScene("door-ajar");
  for (const BackendInfo& backend : backendRegistry()) {
    if (!backend.available) continue;
    SCOPED_TRACE(backend.name);
    SessionConfig config;
    config.integrator = "restir_gi";
    config.denoiser = "accumulate";
    config.backend = backend.name;
    config.threads = 4;
    config.width = 160;
    config.height = 90;
    Session whole(scene, config), stopped(scene, config);
    uint32_t stops = 0;
    for (uint32_t frame = 0; frame < 4; ++frame) {
      stopped.setCamera(cameraOf(*scene, frame + 1));
      for (uint32_t at : {0u, 7u * frame}) {
        if (stopped.frameUnless(stopAt(at))) {
          stopped.takeBack();
        } else {
          ++stops;
        }
      }
      for (Session* session : {&stopped, &whole}) session->setCamera(cameraOf(*scene, frame));
      stopped.frame();
      whole.frame();
      expectSame(stopped, whole);
    }
    EXPECT_GT(stops, 3u);
  }
}

// Covers a filter on the host, and images that were not read before.
TEST(StoppedFrame, IsTakenBackWithItsImage) {
  const auto scene = bias::builtinScene("cornell-box");
  SessionConfig config;
  config.width = 32;
  config.height = 18;
  Session session(scene, config);
  session.frame();
  const Image first = session.radiance();
  ASSERT_TRUE(session.frameUnless([] { return false; }));
  const Image second = session.radiance();
  EXPECT_GT(countDifferent(first, second), 0u);
  session.takeBack();
  EXPECT_EQ(countDifferent(session.radiance(), first), 0u);
  session.frame();
  EXPECT_EQ(countDifferent(session.radiance(), second), 0u) << "it has the number of the other";
}

}  // namespace
}  // namespace restlab::conformance
