// Verdicts of intervals, and which differences make two folders incomparable.
#include "experiments/runner/compare/compare_folders.h"
#include "experiments/runner/tables/summary.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace restlab {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(CompareFolders, AVerdictNeedsAnIntervalThatLeavesOutOne) {
  EXPECT_EQ(verdictOf({0.8, 0.7, 0.9}), Verdict::better);
  EXPECT_EQ(verdictOf({1.2, 1.1, 1.3}), Verdict::worse);
  EXPECT_EQ(verdictOf({1.0, 0.9, 1.1}), Verdict::notToldApart);
  EXPECT_EQ(verdictOf({1.0, 1.0, 1.0}), Verdict::same);
  EXPECT_EQ(verdictOf({0.5, 0.5, 0.5}), Verdict::better);
  // An unknown or unbounded ratio is neither worse nor better.
  EXPECT_EQ(verdictOf({1.2, -kInfinity, kInfinity}), Verdict::notToldApart);
  EXPECT_EQ(verdictOf({1.2, kUnknown, kUnknown}), Verdict::notToldApart);
  EXPECT_EQ(verdictOf({0.4, -0.1, 0.9}), Verdict::notToldApart);
  EXPECT_EQ(verdictOf({-0.4, -0.7, -0.1}), Verdict::notToldApart);
  EXPECT_EQ(verdictOf({3.0, 2.0, kInfinity}), Verdict::notToldApart);
  EXPECT_EQ(verdictOf({kUnknown, kUnknown, kUnknown}), Verdict::notToldApart);
}

// Compares equal distributions of times with a spread of a tenth: of 4000 pairs of sets of 2 runs
// 1.5 % were worse and 1.3 % better, of 8 runs 1.9 and 2.6 %.
TEST(CompareFolders, EqualTimesAreRarelyWorse) {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> time(0.0, 0.1);
  for (const size_t runs : {size_t(2), size_t(8)}) {
    constexpr int kSets = 4000;
    int worse = 0, better = 0;
    for (int set = 0; set < kSets; ++set) {
      std::vector<double> a(runs), b(runs);
      for (double& x : a) x = time(random);
      for (double& x : b) x = time(random);
      const Verdict verdict = verdictOf(geometricRatioInterval(b, a));
      worse += verdict == Verdict::worse;
      better += verdict == Verdict::better;
    }
    EXPECT_LT(double(worse) / kSets, 0.0325) << runs;
    EXPECT_LT(double(better) / kSets, 0.0325) << runs;
  }
}

TEST(CompareFolders, SettingsMakeThingsUnlikeTheRestIsSaid) {
  const Words before = {{"max_bounces", "8"},
                        {"seeds", "1-8"},
                        {"spatial_radius", "8"},
                        {"reference", "(key 01234567, 32 spp, pixels 0)"}};
  Words after = before;
  EXPECT_TRUE(differencesOf(before, after).empty());
  after["max_bounces"] = "2";
  after["seeds"] = "9-16";
  after["new_parameter"] = "1";  // unknown to the older program
  after["reference"] = "(key 89abcdef, 64 spp, pixels 1)";
  const auto differences = differencesOf(before, after);
  ASSERT_EQ(differences.size(), 4u);
  EXPECT_EQ(differences[0].text, "max_bounces 8 / 2");
  EXPECT_TRUE(differences[0].isSetting);
  EXPECT_EQ(differences[1].text, "new_parameter none / 1");
  for (size_t i : {1u, 2u, 3u}) EXPECT_FALSE(differences[i].isSetting) << differences[i].text;
  after["reference"] = "(no key, 0 spp, pixels 1)";
  EXPECT_TRUE(differencesOf(before, after)[2].isSetting) << "an image of nobody knows what";
}

}  // namespace

}  // namespace restlab
