#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/certificate/made_up_runs.h"

namespace restlab::certificate {
namespace {

constexpr uint32_t kSide = 32;

Certificate judged(const Noise& noise, uint64_t runs, const Rules& rules = {},
                   double referenceSigma = 0.005) {
  const Image truth = gradient(kSide);
  return judgeMadeUp(makeEvidence(truth, noise, 1, runs), noise, truth,
                     makeReference(truth, referenceSigma, 2), rules);
}

TEST(Judge, ACorrectMethodIsEquivalent) {
  const Certificate c = judged({}, 128);
  EXPECT_EQ(c.verdict, Verdict::equivalent) << c.reason;
  ASSERT_EQ(c.image.size(), 4u);
  for (const ImageBias& b : c.image) {
    EXPECT_LE(b.bias.lo, b.bias.value);
    EXPECT_GE(b.bias.hi, b.bias.value);
    EXPECT_GT(b.bias.lo, -0.005);
    EXPECT_LT(b.bias.hi, 0.005);
    EXPECT_TRUE(b.isEquivalent);
  }
  EXPECT_FALSE(c.moreRuns);
}

TEST(Judge, ABiasOfAQuarterIsFoundThere) {
  const Certificate c = judged({0.3, 1.0, 0.97}, 128);
  EXPECT_EQ(c.verdict, Verdict::biased) << c.reason;
  EXPECT_GT(c.cells.confirmed, 0u);
  // The quarter has less of the red and the blue gradient than the others.
  EXPECT_LT(c.image[0].bias.hi, 0.0);
  EXPECT_GT(c.image[0].bias.lo, -0.01);
  for (const stats::CellVerdict& v : c.cells.cells) {
    if (!v.confirmed || v.wholeImage) continue;
    EXPECT_LT(v.area.x, 4u);
    EXPECT_LT(v.area.y, 4u);
    EXPECT_EQ(v.side, -1);
  }
}

TEST(Judge, ABiasWithinTheMarginDoesNotCount) {
  // Each test rejects: the noise is far below the bias.
  const Noise noise{0.02, 1.002, 1.0};
  const Certificate c = judged(noise, 128, {}, 0.001);
  EXPECT_GT(c.cells.confirmed, 0u);
  EXPECT_EQ(c.verdict, Verdict::equivalent) << c.reason;
  Rules strict;
  strict.margin = 0.001;
  EXPECT_EQ(judged(noise, 128, strict, 0.001).verdict, Verdict::biased);
}

// What a suite stops at is what would be found biased, and nothing else.
TEST(Judge, FewRunsRejectWhatCounts) {
  const Image truth = gradient(kSide);
  const auto isRejected = [&](const Noise& noise, double margin) {
    Rules rules;
    rules.margin = margin;
    const Reference reference = makeReference(truth, 0.001, 2);
    const Evidence evidence = makeEvidence(truth, noise, 1, 64);
    return rejects(evidence.runs(), truthOf(reference, evidence.runs().grid()), rules);
  };
  EXPECT_TRUE(isRejected({0.3, 1.0, 0.97}, 0.005));
  EXPECT_FALSE(isRejected({}, 0.005));
  // A certain bias that is smaller than the margin.
  EXPECT_TRUE(isRejected({0.02, 1.002, 1.0}, 0.001));
  EXPECT_FALSE(isRejected({0.02, 1.002, 1.0}, 0.005));
}

TEST(Judge, WhatIsNotDecidedSaysHowManyRunsWouldDo) {
  const Noise noise{1.0, 1.0, 1.0};
  const Certificate first = judged(noise, 64);
  ASSERT_EQ(first.verdict, Verdict::notDecided) << first.reason;
  ASSERT_TRUE(first.moreRuns);
  EXPECT_GT(*first.moreRuns, 64u);
  EXPECT_LT(*first.moreRuns, 4096u);
  const Certificate then = judged(noise, 64 + *first.moreRuns);
  EXPECT_EQ(then.verdict, Verdict::equivalent) << then.reason;
}

TEST(Judge, AReferenceThatIsTooCoarseCannotDecide) {
  const Image truth = gradient(kSide);
  const Certificate c =
      judgeMadeUp(makeEvidence(truth, {}, 1, 128), {}, truth, makeReference(truth, 0.5, 2));
  EXPECT_EQ(c.verdict, Verdict::notDecided);
  EXPECT_FALSE(c.moreRuns);
  EXPECT_NE(c.reason.find("the reference's own error"), std::string::npos) << c.reason;
}

TEST(Judge, SkewedMeansHaveNoInterval) {
  // One run in a hundred is a thousand times as bright in one pixel.
  const Image truth = gradient(kSide);
  std::mt19937_64 random(3);
  Evidence evidence(kSide, kSide);
  for (int run = 0; run < 128; ++run) {
    Image image = makeRun(truth, {}, random);
    if (run == 5) image.at(7, 7) *= 1000.0f;
    evidence.add(image);
  }
  const Certificate c = judgeMadeUp(evidence, {}, truth, makeReference(truth, 0.005, 2));
  EXPECT_EQ(c.verdict, Verdict::notDecided) << c.reason;
  EXPECT_NE(c.reason.find("skewed"), std::string::npos) << c.reason;
  EXPECT_LT(c.fewestEvents, 3.0);
  EXPECT_GT(c.cells.untestableShare, 0.0);
  ASSERT_TRUE(c.moreRuns);
  EXPECT_GT(*c.moreRuns, 10'000u);
}

TEST(Judge, WhatIsNotFiniteIsBiased) {
  const Image truth = gradient(kSide);
  std::mt19937_64 random(3);
  Evidence evidence(kSide, kSide);
  for (int run = 0; run < 64; ++run) evidence.add(makeRun(truth, {}, random));
  Image broken = truth;
  broken.at(3, 4).y = std::numeric_limits<float>::quiet_NaN();
  evidence.add(broken);
  const Certificate c = judgeMadeUp(evidence, {}, truth, makeReference(truth, 0.005, 2));
  EXPECT_EQ(c.verdict, Verdict::biased);
  EXPECT_NE(c.reason.find("1 values"), std::string::npos) << c.reason;
}

TEST(Judge, BlackSaysNothing) {
  const Image black(kSide, kSide);
  const Certificate c =
      judgeMadeUp(makeEvidence(black, {}, 1, 64), {}, black, makeReference(black, 0.0, 2));
  EXPECT_EQ(c.verdict, Verdict::notDecided);
  EXPECT_NE(c.reason.find("black"), std::string::npos) << c.reason;
}

// A channel without light is equal in all runs, and does not stand in the way.
TEST(Judge, ABlackChannelIsEquivalent) {
  Image truth = gradient(kSide);
  for (glm::vec3& p : truth.pixels) p.z = 0.0f;
  const Certificate c =
      judgeMadeUp(makeEvidence(truth, {}, 1, 128), {}, truth, makeReference(truth, 0.005, 2));
  EXPECT_EQ(c.verdict, Verdict::equivalent) << c.reason;
}

TEST(Judge, SharesOfTheErrorAreThoseOfBiasAndNoise) {
  const Certificate c = judged({0.1, 1.1, 1.0}, 256);
  double truthSquared = 0.0;
  const Image truth = gradient(kSide);
  for (const glm::vec3& p : truth.pixels) truthSquared += double(glm::dot(p, p)) / 3.0;
  truthSquared /= double(truth.pixels.size());
  EXPECT_NEAR(c.squaredBias.value / (0.01 * truthSquared), 1.0, 0.01);
  EXPECT_NEAR(c.variance.value / (0.0121 * truthSquared), 1.0, 0.03);
}

TEST(Judge, FewRunsAreNoEvidence) {
  EXPECT_THROW(judged({}, kFewestRuns - 1), std::invalid_argument);
}

TEST(RareEvents, AreCounted) {
  std::mt19937_64 random(5);
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) values.push_back(random() % 100 == 0 ? 1.0 : 0.0);
  EXPECT_NEAR(rareEvents(stats::skewness(values), values.size()), 200.0, 40.0);
  EXPECT_TRUE(std::isinf(rareEvents(0.0, 100)));
}

}  // namespace
}  // namespace restlab::certificate
