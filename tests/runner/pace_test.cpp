// Estimated remaining time of a suite.
#include "experiments/runner/base/pace.h"

#include <gtest/gtest.h>

namespace restlab {

namespace {

TEST(Pace, RunsThatWereThereTakeNoTime) {
  Pace pace;
  pace.plan(4, 1.0);
  pace.plan(6, 1.0);
  EXPECT_EQ(pace.progress().total, 10u);
  EXPECT_EQ(pace.progress().leftS, 0.0) << "nothing is known yet";
  pace.found(1.0);
  pace.made(2.0, 1.0);
  pace.made(4.0, 1.0);
  EXPECT_EQ(pace.progress().done, 3u);
  EXPECT_EQ(pace.progress().leftS, 7 * 3.0);
  for (int i = 0; i < 8; ++i) pace.made(3.0, 1.0);
  EXPECT_EQ(pace.progress().leftS, 0.0) << "one was damaged and made twice";
}

// A sweep over sizes begins with small ones: the mean time of its first runs does not predict the
// last.
TEST(Pace, TimeGoesByTheCostOfWhatIsLeft) {
  Pace pace;
  pace.plan(2, 100.0);
  pace.plan(2, 1600.0);
  pace.made(1.0, 100.0);
  pace.made(1.0, 100.0);
  EXPECT_DOUBLE_EQ(pace.progress().leftS, 2 * 16.0);
  pace.made(20.0, 1600.0);
  EXPECT_NEAR(pace.progress().leftS, 22.0 / 1800.0 * 1600.0, 1e-12);
}

}  // namespace

}  // namespace restlab
