// Tests of the exposure with which a page opens.
#include "experiments/view/view_exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/tables/preview.h"
#include "tests/view/small_panes.h"

namespace restlab::view_test {
namespace {

TEST(ViewExposure, OfTheFirstFrameIsNearThatOfTheReport) {
  std::vector<SessionConfig> panes = {smallPane("restir_gi"), smallPane("path", "accumulate")};
  for (SessionConfig& pane : panes) {
    pane.width = 160;
    pane.height = 90;
  }
  LiveView view(cornellBox(), panes, {});
  EXPECT_EQ(exposureOf(view), 1.0) << "nothing is there";
  view.renderFrames();
  const double first = exposureOf(view);
  for (int i = 0; i < 32; ++i) view.refineReference();
  const double report = previewExposure(view.reference().mean());
  EXPECT_EQ(exposureOf(view), report);
  EXPECT_NEAR(std::log2(first / report), 0.0, 0.5);
}

// A pane that no page shows keeps the picture of an earlier camera, which says nothing.
TEST(ViewExposure, NothingIsLitThoughAHiddenPaneWas) {
  LiveView view(cornellBox(), {smallPane("path"), smallPane("path")}, {});
  view.renderFrames();
  EXPECT_FALSE(isNothingLit(view));
  view.setSeen(1, false);
  MoveCamera away;
  away.toWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1000, 1};  // far behind, looking away
  view.apply(away);
  view.renderFrames();
  EXPECT_TRUE(isNothingLit(view));
}

}  // namespace
}  // namespace restlab::view_test
