#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "experiments/statistics/holm.h"
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
  // The quarter has less of the red and blue gradients than the others.
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
  // All tests reject, because the noise is far below the bias.
  const Noise noise{0.02, 1.002, 1.0};
  const Certificate c = judged(noise, 128, {}, 0.001);
  EXPECT_GT(c.cells.confirmed, 0u);
  EXPECT_EQ(c.verdict, Verdict::equivalent) << c.reason;
  Rules strict;
  strict.margin = 0.001;
  EXPECT_EQ(judged(noise, 128, strict, 0.001).verdict, Verdict::biased);
}

// Pilot runs reject exactly what a certificate would find biased.
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
  // A clear bias that is smaller than the margin.
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
  // One of 128 runs is a thousand times as bright in one pixel.
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
  EXPECT_NE(c.reason.find("1 value of its images"), std::string::npos) << c.reason;
}

// Kernels set such values to zero, so images do not show them.
TEST(Judge, WhatWasSetToZeroIsBiased) {
  Certificate c = judged({}, 128);
  countNonfiniteSamples(c, 0);
  EXPECT_EQ(c.verdict, Verdict::equivalent);
  countNonfiniteSamples(c, 7);
  EXPECT_EQ(c.verdict, Verdict::biased);
  EXPECT_EQ(c.reason, "7 sample values of its runs were not finite, and were set to zero");
  Certificate wrong = judged({0.3, 1.0, 0.97}, 128);
  countNonfiniteSamples(wrong, 1);
  EXPECT_NE(wrong.reason.find("1 sample value of its runs were not finite; luminance of the image"),
            std::string::npos)
      << wrong.reason;
}

// After an unconfirmed rejection the certificate asks for as many runs again, not for one more.
TEST(Judge, AnUnconfirmedRejectionAsksForAsManyAgain) {
  const Image truth = gradient(kSide);
  const Noise wrong{0.3, 1.03, 1.0}, right{0.3, 1.0, 1.0};
  const Evidence evidence = makeEvidence(truth, wrong, 1, 128);
  const Certificate c = judge(
      evidence, evidence.runs(), [&] { return makeEvidence(truth, right, 3, 128).runs(); },
      makeReference(truth, 0.005, 2), Rules());
  ASSERT_EQ(c.verdict, Verdict::notDecided) << c.reason;
  EXPECT_GT(c.cells.rejected, c.cells.confirmed);
  EXPECT_NE(c.reason.find("fresh runs did not confirm"), std::string::npos) << c.reason;
  ASSERT_TRUE(c.moreRuns);
  EXPECT_GE(*c.moreRuns, 128u);
}

// If only every second image is in the first batch, twice as many images are needed.
TEST(Judge, BatchesOfHalfTheRunsAskForTwiceAsMany) {
  const Image truth = gradient(kSide);
  const Noise noise{3.0, 1.02, 1.0};
  const Evidence evidence = makeEvidence(truth, noise, 1, 128);
  const Evidence half = makeEvidence(truth, noise, 1, 64);
  const Reference reference = makeReference(truth, 0.005, 2);
  const auto more = [&](const stats::RunSet& batch) {
    const Certificate c = judge(
        evidence, batch, [&] { return makeEvidence(truth, noise, 3, batch.runs()).runs(); },
        reference, Rules());
    EXPECT_EQ(c.verdict, Verdict::notDecided) << c.reason;
    return c.moreRuns.value_or(0);
  };
  EXPECT_NEAR(double(more(half.runs()) + 128), 2.0 * double(more(evidence.runs()) + 128), 4.0);
}

TEST(Judge, ABiasNearTheMarginIsNotTheReferencesFault) {
  // A bias near the margin of 0.5 % needs a better reference, although this one is good enough for
  // a bias of 0.
  const Certificate c = judged({0.02, 1.002, 1.0}, 128, {}, 0.05);
  ASSERT_EQ(c.verdict, Verdict::notDecided) << c.reason;
  EXPECT_FALSE(c.moreRuns);
  EXPECT_NE(c.reason.find("too near the margin"), std::string::npos) << c.reason;
}

TEST(Judge, BiasesOfBlackCellsAreNotRelative) {
  stats::CellVerdict cell;
  cell.reference = 0.0;
  cell.welch.difference = 0.25;
  EXPECT_EQ(relativeText(cell, 2), "+0.25 where the reference is black");
  cell.reference = 0.5;
  EXPECT_EQ(relativeText(cell, 1), "+50.0 %");
}

TEST(Judge, BlackSaysNothing) {
  const Image black(kSide, kSide);
  const Certificate c =
      judgeMadeUp(makeEvidence(black, {}, 1, 64), {}, black, makeReference(black, 0.0, 2));
  EXPECT_EQ(c.verdict, Verdict::notDecided);
  EXPECT_NE(c.reason.find("black"), std::string::npos) << c.reason;
}

// A channel without light is equal in all runs, and does not prevent a verdict.
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

// Holm's correction covers all cells of all quantities: not every test below 0.1 % is rejected.
TEST(Judge, AllTestsAreOneFamily) {
  const Certificate c = judged({0.3, 1.0, 0.985}, 128);
  std::vector<double> pValues;
  for (const stats::CellVerdict& v : c.cells.cells)
    if (v.testable) pValues.push_back(v.welch.pValue);
  EXPECT_GT(pValues.size(), 200u);
  const std::vector<double> adjusted = stats::holmAdjusted(pValues);
  size_t next = 0, alone = 0;
  for (const stats::CellVerdict& v : c.cells.cells) {
    if (!v.testable) continue;
    EXPECT_EQ(v.adjustedP, adjusted[next]);
    EXPECT_EQ(v.side != 0, adjusted[next] <= Rules().familyError);
    alone += pValues[next++] <= Rules().familyError ? 1 : 0;
  }
  EXPECT_GT(c.cells.rejected, 0u);
  EXPECT_GT(alone, c.cells.rejected);
}

TEST(Judge, AnImageHasAtMost64Cells) {
  // Blocks of eight or nine pixels per side.
  constexpr uint32_t kOdd = 67;
  const Image truth = gradient(kOdd);
  const Certificate c =
      judgeMadeUp(makeEvidence(truth, {}, 1, 64), {}, truth, makeReference(truth, 0.005, 2));
  const stats::BlockGrid grid(kOdd, kOdd);
  for (const stats::Quantity quantity : quantities()) {
    size_t cells = 0;
    uint64_t pixels = 0;
    for (const stats::CellVerdict& v : c.cells.cells) {
      if (v.quantity != quantity || v.wholeImage) continue;
      ++cells;
      pixels += stats::pixelCount(grid, v.area);
    }
    EXPECT_LE(cells, 64u);
    EXPECT_GT(cells, 16u);
    EXPECT_EQ(pixels, uint64_t(kOdd) * kOdd);
  }
}

// A pixel factor with deviation 10 is skewed in any cell, one of 0.3 in none; in between, cells are
// merged until they are not skewed.
TEST(Judge, WhatIsTestedIsNearlyNormal) {
  size_t merged = 0;
  for (const double sigma : {0.3, 2.0, 10.0}) {
    constexpr uint64_t kRuns = 128;
    const Certificate c = judged({sigma, 1.0, 1.0}, kRuns);
    size_t tested = 0;
    for (const stats::CellVerdict& v : c.cells.cells) {
      const double scaled = std::abs(v.skewness) / std::sqrt(double(kRuns));
      EXPECT_EQ(v.testable, scaled <= 0.05) << sigma << ": " << scaled;
      tested += v.testable ? 1 : 0;
      merged += v.testable && !v.wholeImage && v.area.size > 1 ? 1 : 0;
    }
    if (sigma < 1.0) {
      EXPECT_GT(tested, 200u);
    } else if (sigma > 5.0) {
      EXPECT_EQ(tested, 0u);
      EXPECT_EQ(c.cells.untestableShare, 1.0);
    }
  }
  EXPECT_GT(merged, 0u);
}

// A fresh batch must reject what the first one rejects, on the same side.
TEST(Judge, AFreshBatchHasToSayTheSame) {
  const Image truth = gradient(kSide);
  const Reference reference = makeReference(truth, 0.005, 2);
  const Evidence dark = makeEvidence(truth, {0.3, 1.0, 0.9}, 1, 128);
  for (const double quarter : {1.0, 1.1, 0.9}) {
    int calls = 0;
    const Certificate c = judge(
        dark, dark.runs(),
        [&] {
          ++calls;
          return makeEvidence(truth, {0.3, 1.0, quarter}, 3, 128).runs();
        },
        reference, Rules());
    EXPECT_EQ(calls, 1);
    EXPECT_GT(c.cells.rejected, 0u);
    EXPECT_EQ(c.cells.confirmed > 0, quarter < 1.0) << quarter;
    EXPECT_EQ(c.verdict == Verdict::biased, quarter < 1.0) << quarter << ": " << c.reason;
  }
  // Without a rejection no fresh batch is rendered.
  const Evidence right = makeEvidence(truth, {}, 1, 128);
  const auto none = [&]() -> stats::RunSet {
    ADD_FAILURE() << "no fresh batch was wanted";
    return right.runs();
  };
  EXPECT_EQ(judge(right, right.runs(), none, reference, Rules()).verdict, Verdict::equivalent);
}

// A block that is bright in 4 of 128 runs: n q (1 - q) / (1 - 2 q)^2 events with q = 4 / 128.
// Another block is bright in a third of the runs, and so is the whole image.
TEST(Judge, TheWorstCellSaysHowManyEventsItHas) {
  const Image truth = gradient(kSide);
  std::mt19937_64 random(3);
  Evidence evidence(kSide, kSide);
  for (int run = 0; run < 128; ++run) {
    Image image = makeRun(truth, {0.01, 1.0, 1.0}, random);
    if (run % 32 == 7) image.at(20, 9) *= 1000.0f;
    if (run % 3 == 1) image.at(3, 25) *= 1000.0f;
    evidence.add(image);
  }
  const Certificate c = judgeMadeUp(evidence, {}, truth, makeReference(truth, 0.005, 2));
  const double q = 4.0 / 128.0;
  EXPECT_NEAR(c.fewestEvents, 128.0 * q * (1.0 - q) / ((1.0 - 2.0 * q) * (1.0 - 2.0 * q)), 0.01);
}

// Half of the runs are a tenth above the truth, half a tenth below.
Evidence evenly(const Image& truth, int runs) {
  Evidence evidence(truth.width, truth.height);
  for (int run = 0; run < runs; ++run) {
    Image image = truth;
    for (glm::vec3& p : image.pixels) p *= run % 2 == 0 ? 0.9f : 1.1f;
    evidence.add(image);
  }
  return evidence;
}

// 95 % intervals of four quantities that lie within the margin nine times out of ten: each 39 times
// out of 40, with a standard error of margin / (1.960 + 2.241).
TEST(RunsForEquivalence, KnownValues) {
  Reference reference;
  reference.mean = gradient(kSide);
  const Evidence pilot = evenly(reference.mean, 64);
  const stats::BlockGrid& grid = pilot.runs().grid();
  const double variance = 0.01 * 64.0 / 63.0, deviations = 1.959963985 + 2.241402728;
  const auto runs = [&](double margin) {
    Rules rules;
    rules.margin = margin;
    return runsForEquivalence(pilot, truthOf(reference, grid), rules);
  };
  const double wanted = variance * deviations * deviations;
  EXPECT_NEAR(runs(0.005) / (wanted / (0.005 * 0.005)), 1.0, 1e-5);
  EXPECT_NEAR(runs(0.02) / (wanted / (0.02 * 0.02)), 1.0, 1e-5);
  EXPECT_EQ(runs(0.2), 128.0);  // minimum for cells
  // A reference with an error needs more runs; with too large an error no number is enough.
  EXPECT_EQ(relativeError(truthOf(reference, grid)), 0.0);
  reference.half0 = reference.half1 = reference.mean;
  for (glm::vec3& p : reference.half0->pixels) p *= 1.032f;
  for (glm::vec3& p : reference.half1->pixels) p *= 0.968f;
  // Red has the largest error, because its pixels differ most: deviations of 3.2 % of each pixel.
  double squares = 0.0, sum = 0.0;
  for (const glm::vec3& p : reference.mean.pixels) {
    squares += 0.032 * 0.032 * double(p.x) * double(p.x);
    sum += double(p.x);
  }
  const double error = relativeError(truthOf(reference, grid));
  EXPECT_NEAR(error / (std::sqrt(squares) / sum), 1.0, 1e-4);
  const double allowed = 0.005 * 0.005 / (deviations * deviations) - error * error;
  ASSERT_GT(allowed, 0.0);
  EXPECT_NEAR(runs(0.005) / (variance / allowed), 1.0, 1e-3);
  EXPECT_TRUE(std::isnan(runs(0.002)));
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
