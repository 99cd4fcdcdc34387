// Undo and redo: which changes form a step, and that each step restores the settings.
#include "experiments/view/view_history.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "experiments/view/live_view.h"
#include "tests/view/small_panes.h"

namespace restlab {
namespace {

class ViewStepsTest : public ::testing::Test {
 protected:
  static MoveCamera cameraAt(const LiveView& view, double x) {
    MoveCamera move;
    for (int i = 0; i < 16; ++i)
      move.toWorld[size_t(i)] =
          view.loaded().scene->source().cameras[0].cameraToWorld[i / 4][i % 4];
    move.toWorld[12] += x;
    return move;
  }

  LiveView view_{
      view_test::cornellBox(),
      {view_test::smallPane("restir_gi", "none"), view_test::smallPane("path", "accumulate")},
      {}};
};

TEST_F(ViewStepsTest, EachLeadsBackAndForth) {
  const ViewCommand commands[] = {
      SetSetting{0, "mode", "biased"},
      SetParameter{0, "confidence_cap", ParameterValue(int64_t{8})},
      SetParameter{1, "accumulate_cap", ParameterValue(5.0)},
      SetLight{"all", 0.5},
      cameraAt(view_, 0.25),
      Resize{16, 10},
      ShowLayer{0, "age"},
      SetSetting{1, "denoiser", "svgf"},
      CopyMethod{1, 0},
      SetParameter{1, "accumulate_cap", std::nullopt},
  };
  std::vector<ViewSettings> passed = {view_.settings()};
  for (const ViewCommand& command : commands) {
    try {
      view_.apply(command);
    } catch (const Error&) {
      continue;  // svgf has no accumulate_cap
    }
    view_.renderFrames();
    passed.push_back(view_.settings());
    EXPECT_FALSE(isSame(passed.back(), *(passed.end() - 2))) << command.index();
  }
  for (size_t i = passed.size() - 1; i > 0; --i) {
    const uint64_t epoch = view_.epoch();
    view_.apply(Undo{});
    EXPECT_TRUE(isSame(view_.settings(), passed[i - 1])) << i;
    EXPECT_EQ(view_.epoch() > epoch,
              passed[i].panes[0].layer == passed[i - 1].panes[0].layer ||
                  !isSamePicture(passed[i], passed[i - 1]) ||
                  passed[i].panes[0].config.integrator != passed[i - 1].panes[0].config.integrator);
    view_.renderFrames();
  }
  EXPECT_THROW(view_.apply(Undo{}), Error);
  for (size_t i = 1; i < passed.size(); ++i) {
    view_.apply(Redo{});
    EXPECT_TRUE(isSame(view_.settings(), passed[i])) << i;
  }
  EXPECT_THROW(view_.apply(Redo{}), Error);
  // Panes must render the settings, not only list them.
  view_.apply(Restart{});
  view_.renderFrames();
  for (size_t i = 0; i < view_.panes(); ++i) {
    const LiveView other(view_test::cornellBox(), view_.settings(), {});
    EXPECT_EQ(other.session(i).config().parameters, view_.session(i).config().parameters);
    EXPECT_EQ(other.session(i).config().denoiser, view_.session(i).config().denoiser);
    EXPECT_EQ(view_.session(i).radiance().width, 16u);
  }
}

TEST_F(ViewStepsTest, ADragIsOne) {
  for (int i = 1; i <= 5; ++i) view_.apply(cameraAt(view_, 0.1 * i));
  for (int64_t cap : {3, 4, 5}) view_.apply(SetParameter{0, "confidence_cap", ParameterValue(cap)});
  EXPECT_EQ(view_.history().undoText(), "A: confidence_cap = 5");
  view_.apply(Undo{});
  EXPECT_EQ(view_.history().undoText(), "camera");
  EXPECT_EQ(view_.history().redoText(), "A: confidence_cap = 5");
  view_.apply(Undo{});
  EXPECT_FALSE(view_.history().canUndo());
  EXPECT_TRUE(isSameCamera(view_.camera(), view_.loaded().scene->source().cameras[0]));
  // A change after an undo is a new step and discards the redo steps.
  view_.apply(Redo{});
  view_.apply(cameraAt(view_, 0.7));
  EXPECT_FALSE(view_.history().canRedo());
  view_.apply(Undo{});
  EXPECT_NEAR(view_.camera().cameraToWorld[3][0],
              view_.loaded().scene->source().cameras[0].cameraToWorld[3][0] + 0.5, 1e-12);
}

// After a long pause a change is a new step: the value before it can be restored.
TEST_F(ViewStepsTest, APauseEndsADrag) {
  ViewHistory history;
  const auto begun = ViewHistory::Clock::now();
  for (const int tenths : {0, 5, 15, 35, 56}) {
    history.add(view_.settings(), "camera", fmt::format("{}", tenths),
                begun + std::chrono::milliseconds(100) * tenths);
  }
  EXPECT_EQ(history.undoText(), "56");
  history.undo(view_.settings());
  ASSERT_EQ(history.undoText(), "35") << "no pause between them was longer than two seconds";
  history.undo(view_.settings());
  EXPECT_FALSE(history.canUndo());
}

TEST_F(ViewStepsTest, WhatChangesNothingIsNone) {
  view_.apply(cameraAt(view_, 0.0));
  view_.apply(SetSetting{0, "mode", view_.settings().panes[0].config.mode});
  EXPECT_FALSE(view_.history().canUndo());
  EXPECT_EQ(view_.epoch(), 1u);
}

}  // namespace
}  // namespace restlab
