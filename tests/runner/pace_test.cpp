// How long the rest of a suite takes, by the runs that were made.
#include "experiments/runner/run/pace.h"

#include <gtest/gtest.h>

namespace restlab {

namespace {

TEST(Pace, RunsThatWereThereTakeNoTime) {
  Pace pace;
  pace.plan(4);
  pace.plan(6);
  EXPECT_EQ(pace.progress().total, 10u);
  EXPECT_EQ(pace.progress().leftS, 0.0) << "nothing is known yet";
  pace.found();
  pace.made(2.0);
  pace.made(4.0);
  EXPECT_EQ(pace.progress().done, 3u);
  EXPECT_EQ(pace.progress().leftS, 7 * 3.0);
  for (int i = 0; i < 8; ++i) pace.made(3.0);
  EXPECT_EQ(pace.progress().leftS, 0.0) << "one was damaged and made twice";
}

}  // namespace

}  // namespace restlab
