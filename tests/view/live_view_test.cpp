// Panes and reference of the viewer, without its page: turns, changes, numbers.
#include "experiments/view/live_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/runner/run/experiment.h"
#include "tests/runner/temporary_folder.h"
#include "tests/view/small_panes.h"

namespace restlab {
namespace {

class LiveViewTest : public TemporaryFolder {
 protected:
  LiveView open(const ReferenceStore& store = {}) {
    return {view_test::cornellBox(),
            {view_test::smallPane("restir_gi"), view_test::smallPane("path", "accumulate")},
            store};
  }
  static std::vector<glm::vec3> pixels(const Session& session) { return session.radiance().pixels; }
  std::string errorOf(LiveView& view, const ViewCommand& command) {
    const uint64_t before = view.epoch();
    try {
      view.apply(command);
    } catch (const Error& error) {
      EXPECT_EQ(view.epoch(), before) << "a command that fails changes nothing";
      return error.what();
    }
    return "none";
  }
};

TEST_F(LiveViewTest, PanesRenderWhatSessionsDo) {
  LiveView view = open();
  Session gi(view_test::cornellBox().scene, view_test::smallPane("restir_gi")),
      path(view_test::cornellBox().scene, view_test::smallPane("path", "accumulate"));
  for (int frame = 0; frame < 3; ++frame) {
    view.renderFrames();
    gi.frame();
    path.frame();
  }
  EXPECT_EQ(pixels(view.session(0)), pixels(gi));
  EXPECT_EQ(pixels(view.session(1)), pixels(path));
  EXPECT_GT(view.stats(0).raysPath, 0u);
}

TEST_F(LiveViewTest, NumbersAreThoseOfTheFramesSinceTheReferenceWasThere) {
  LiveView view = open();
  view.renderFrames();
  EXPECT_EQ(view.error(0).frames(), 0u);
  for (int sample = 0; sample < 8; ++sample) view.refineReference();
  ASSERT_TRUE(view.reference().hasImage());
  EXPECT_EQ(view.reference().spp(), 8u);
  EXPECT_GT(view.reference().relmse(), 0.0);
  double sum = 0.0;
  for (int frame = 0; frame < 4; ++frame) {
    view.renderFrames();
    sum += mseAgainstHalves(view.session(1).radiance(), view.reference().half0(),
                            view.reference().half1());
  }
  EXPECT_EQ(view.error(1).frames(), 4u);
  EXPECT_DOUBLE_EQ(view.error(1).mse().value, sum / 4.0);
  EXPECT_TRUE(std::isnan(view.error(1).mse().lo)) << "four frames of a history say little";
  EXPECT_NEAR(view.error(1).energyRatio().value, 1.0, 0.5);
}

// Exact with the same seed and the same reference.
TEST_F(LiveViewTest, NumbersOfAFrameAreThoseOfASuite) {
  LiveView view = open();
  for (int sample = 0; sample < 6; ++sample) view.refineReference();
  Reference reference;
  reference.mean = view.reference().mean();
  reference.half0 = view.reference().half0();
  reference.half1 = view.reference().half1();
  Session gi(view_test::cornellBox().scene, view_test::smallPane("restir_gi"));
  double mse = 0.0, relmse = 0.0, energy = 0.0;
  constexpr uint32_t kFrames = 5;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    view.renderFrames();
    gi.frame();
    const FrameError error = measureFrame(gi.radiance(), reference, frame, {});
    EXPECT_EQ(view.error(0).lastMse(), error.mse);
    mse += error.mse;
    relmse += error.relmse;
    energy += error.energyRatio;
  }
  EXPECT_EQ(view.frames(0), kFrames);
  EXPECT_DOUBLE_EQ(view.error(0).mse().value, mse / kFrames);
  EXPECT_DOUBLE_EQ(view.error(0).relmse().value, relmse / kFrames);
  EXPECT_NEAR(view.error(0).energyRatio().value, energy / kFrames, 1e-9);
}

TEST_F(LiveViewTest, EveryChangeBeginsTheNumbersAnew) {
  LiveView view = open();
  view.refineReference();
  view.refineReference();
  SceneCamera camera = view.camera();
  MoveCamera move;
  for (int i = 0; i < 16; ++i) move.toWorld[size_t(i)] = camera.cameraToWorld[i / 4][i % 4];
  move.toWorld[12] += 0.1;
  struct Case {
    ViewCommand command;
    bool ofPanes[2];  // panes whose numbers begin anew
    bool isAnotherPicture;
  };
  const Case changes[] = {
      {SetSetting{0, "mode", "biased"}, {true, false}, false},
      {SetSetting{1, "denoiser", "svgf"}, {false, true}, false},
      {SetSetting{0, "cache", "voxel"}, {true, false}, false},
      {SetParameter{0, "confidence_cap", ParameterValue(int64_t{8})}, {true, false}, false},
      {SetParameter{0, "confidence_cap", std::nullopt}, {true, false}, false},
      {Restart{}, {true, true}, false},
      {move, {true, true}, true},
      {Resize{20, 12}, {true, true}, true},
      {SetLight{"all", 0.5}, {true, true}, true},
  };
  for (const auto& [command, ofPanes, isAnotherPicture] : changes) {
    SCOPED_TRACE(command.index());
    while (!view.reference().hasImage()) view.refineReference();
    view.renderFrames();
    EXPECT_GT(view.error(0).frames(), 0u);
    const uint64_t before = view.epoch();
    view.apply(command);
    EXPECT_GT(view.epoch(), before);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(view.error(i).frames() == 0, ofPanes[i]) << i;
    EXPECT_EQ(view.reference().spp() == 0, isAnotherPicture);
    view.renderFrames();
  }
  EXPECT_EQ(view.session(0).radiance().width, 20u);
  EXPECT_EQ(view.session(0).config().mode, "biased");
}

TEST_F(LiveViewTest, AMovedCameraGoesOnWithItsHistory) {
  LiveView view = open();
  Session gi(view_test::cornellBox().scene, view_test::smallPane("restir_gi"));
  MoveCamera move;
  SceneCamera camera = view.camera();
  for (int frame = 0; frame < 4; ++frame) {
    if (frame == 2) {
      for (int i = 0; i < 16; ++i) move.toWorld[size_t(i)] = camera.cameraToWorld[i / 4][i % 4];
      move.toWorld[13] += 0.2;
      view.apply(move);
      camera.cameraToWorld[3][1] += 0.2;
      gi.setCamera(camera);
    }
    view.renderFrames();
    gi.frame();
  }
  EXPECT_EQ(pixels(view.session(0)), pixels(gi));
}

// A page says neither shift nor mirroring: the scene's cameras at the place do.
TEST_F(LiveViewTest, AScenesCameraIsShownWithItsShift) {
  PreparedScene prepared = view_test::cornellBox();
  Scene scene = prepared.scene->source();
  scene.cameras.resize(1);
  scene.cameras[0].shift = {0.25, 0.0};
  for (const double yfov : {0.5, 0.75}) {
    SceneCamera& other = scene.cameras.emplace_back(scene.cameras[0]);
    other.cameraToWorld[3][0] += 0.5;
    other.yfov = yfov;
    other.shift = {0.0, yfov};
  }
  scene.cameras[1].shift = glm::dvec2(0.0);
  const std::vector<SceneCamera> cameras = scene.cameras;
  prepared.scene = CompiledScene::build(std::move(scene));
  LiveView view(prepared, {view_test::smallPane("path")}, {});
  for (const size_t index : {size_t(1), size_t(2), size_t(0), size_t(2), size_t(1)}) {
    MoveCamera move;
    for (int i = 0; i < 16; ++i)
      move.toWorld[size_t(i)] = cameras[index].cameraToWorld[i / 4][i % 4];
    move.yfov = cameras[index].yfov;
    view.apply(move);
    EXPECT_EQ(view.camera().shift, cameras[index].shift) << index;
    move.yfov = 0.6;  // no camera's: keeps what is shown
    view.apply(move);
    EXPECT_EQ(view.camera().shift, cameras[index].shift) << index;
  }
}

TEST_F(LiveViewTest, WhatCannotBeDoneChangesNothing) {
  LiveView view = open();
  view.renderFrames();
  EXPECT_NE(errorOf(view, SetSetting{0, "integrater", "path"}).find("did you mean 'integrator'?"),
            std::string::npos);
  EXPECT_NE(errorOf(view, SetSetting{0, "integrator", "pth"}).find("'path'"), std::string::npos);
  EXPECT_NE(errorOf(view, SetSetting{1, "cache", "voxel"}).find("path"), std::string::npos);
  EXPECT_NE(errorOf(view, SetParameter{0, "confidence_cup", int64_t{3}}).find("'confidence_cap'"),
            std::string::npos);
  EXPECT_NE(errorOf(view, SetParameter{0, "confidence_cap", -1.0}).find("confidence_cap"),
            std::string::npos);
  EXPECT_NE(errorOf(view, SetLight{"lampe", 2.0}).find("lampe"), std::string::npos);
  EXPECT_NE(errorOf(view, ShowLayer{0, "agee"}).find("'age'"), std::string::npos);
  view.renderFrames();
  Session gi(view_test::cornellBox().scene, view_test::smallPane("restir_gi"));
  gi.frames(2);
  EXPECT_EQ(pixels(view.session(0)), pixels(gi));
}

TEST_F(LiveViewTest, AnotherIntegratorKeepsWhatItHas) {
  LiveView view = open();
  view.apply(SetParameter{0, "confidence_cap", ParameterValue(int64_t{8})});
  view.apply(SetSetting{0, "denoiser", "accumulate"});
  view.apply(SetParameter{0, "accumulate_cap", ParameterValue(5.0)});
  view.apply(SetSetting{0, "integrator", "path"});
  EXPECT_EQ(view.session(0).config().parameters.at("accumulate_cap"), ParameterValue(5.0));
  EXPECT_EQ(view.session(0).config().parameters.count("confidence_cap"), 0u);
  view.renderFrames();
}

// The reference of the scene's own camera is the one that other programs store.
TEST_F(LiveViewTest, TheReferenceGoesOnFromWhatIsKept) {
  ReferenceStore store;
  store.folder = folder();
  {
    LiveView view = open(store);
    for (int sample = 0; sample < 6; ++sample) view.refineReference();
  }
  LiveView view = open(store);
  EXPECT_EQ(view.reference().spp(), 6u);
  view.refineReference();
  EXPECT_EQ(view.reference().spp(), 7u);
  LiveView anew = open();
  for (int sample = 0; sample < 7; ++sample) anew.refineReference();
  EXPECT_EQ(view.reference().mean().pixels, anew.reference().mean().pixels);
}

// The panes' runs restart, the reference does not.
TEST_F(LiveViewTest, TheReferenceHasItsSeedAfterARestart) {
  ReferenceStore store;
  store.folder = folder();
  LiveView view = open(store);
  for (int sample = 0; sample < 6; ++sample) view.refineReference();
  view.apply(Restart{});
  view.apply(Resize{20, 12});
  view.apply(Resize{24, 16});
  EXPECT_EQ(view.reference().spp(), 6u) << "it is the one that was kept";
}

TEST_F(LiveViewTest, ACopyIsARunOfItsOwn) {
  LiveView view = open();
  view.apply(CopyMethod{0, 1});
  EXPECT_EQ(view.settings().panes[1].config.integrator, "restir_gi");
  view.renderFrames();
  EXPECT_NE(view.settings().panes[0].config.seed, view.settings().panes[1].config.seed);
  EXPECT_NE(pixels(view.session(0)), pixels(view.session(1)));
  SessionConfig other = view_test::smallPane("restir_gi");
  other.seed = view.settings().panes[1].config.seed;
  Session again(view_test::cornellBox().scene, other);
  again.frame();
  EXPECT_EQ(pixels(view.session(1)), pixels(again)) << "the seed that it says";
  view.apply(Restart{});
  view.renderFrames();
  EXPECT_NE(pixels(view.session(0)), pixels(view.session(1)));
}

TEST(RunningErrors, HaveAMeanOfTheNewestFrames) {
  const Image one(1, 1, glm::vec3(1.0f));
  RunningError error;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  error.add(Image(1, 1, glm::vec3(nan)), one, one, one, 8);
  for (size_t i = 0; i < 10; ++i) error.add(Image(1, 1, glm::vec3(11.0f)), one, one, one, 8);
  EXPECT_TRUE(std::isnan(error.newestMse())) << "there are fewer";
  for (size_t i = 0; i < RunningError::kNewest; ++i)
    error.add(Image(1, 1, glm::vec3(3.0f)), one, one, one, 8);
  EXPECT_DOUBLE_EQ(error.newestMse(), 4.0) << "without those before, whatever they were";
  EXPECT_GT(error.newestRelmse(), 0.0);
  EXPECT_TRUE(std::isnan(error.mse().value));
  error.restart();
  EXPECT_TRUE(std::isnan(error.newestMse()));
}

// Means are read after each round, for hours.
TEST(RunningErrors, CostTheSameHoweverLongTheWindowIs) {
  const Image one(1, 1, glm::vec3(1.0f));
  RunningError error;
  const auto secondsOf = [&](size_t frames) {
    while (error.frames() < frames) error.add(one, one, one, one, 8);
    double best = 1.0;
    for (int trial = 0; trial < 5; ++trial) {
      const auto begun = std::chrono::steady_clock::now();
      double sum = 0.0;
      for (int i = 0; i < 20; ++i) sum += error.mse().value + error.newestMse();
      EXPECT_EQ(sum, 0.0);
      best = std::min(
          best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
    }
    return best;
  };
  const double few = secondsOf(1000);
  EXPECT_LT(secondsOf(300000), 20.0 * few);
}

TEST(RunningErrors, HaveIntervalsOfBatches) {
  const Image zero(1, 1, glm::vec3(0.0f)), one(1, 1, glm::vec3(1.0f));
  RunningError error;
  for (size_t i = 0; i < RunningError::kLeastFrames; ++i)
    error.add(Image(1, 1, glm::vec3(i % 2 == 0 ? 1.0f : 3.0f)), one, one, one, 8);
  EXPECT_DOUBLE_EQ(error.mse().value, 2.0);  // (0 + 4) / 2
  EXPECT_DOUBLE_EQ(error.mse().lo, 2.0) << "batches of as many of each have no spread";
  EXPECT_DOUBLE_EQ(error.energyRatio().value, 2.0);
  for (size_t i = 0; i < RunningError::kLeastFrames; ++i) error.add(one, one, one, one, 8);
  EXPECT_DOUBLE_EQ(error.mse().value, 1.0);
  EXPECT_LT(error.mse().lo, 1.0);
  EXPECT_GT(error.mse().hi, 1.0);
  error.restart();
  EXPECT_EQ(error.frames(), 0u);
  EXPECT_TRUE(std::isnan(error.mse().value));
}

}  // namespace
}  // namespace restlab
