// Rows from runs with known numbers: means, ratios, bias, and the rules for counting a row.
#include "experiments/runner/tables/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "experiments/runner/tables/report.h"
#include "tests/runner/summary_fixture.h"

namespace restlab {

namespace {

TEST_F(SummaryTest, MeansAndRatios) {
  const auto rows = summarise(suite_, block_);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows[0].mse.value, 1.0, 1e-12);
  EXPECT_NEAR(rows[1].mse.value, 0.1, 1e-12);
  EXPECT_NEAR(rows[1].mseRatio.value, 10.0, 1e-12);
  // Without lights: path (0.4 + 0.25 + 0.3) / 3, gi (0.05 + 0.02 + 0.03) / 3.
  EXPECT_NEAR(rows[1].mseRatioWithoutLights.value, 9.5, 1e-9);
  EXPECT_LT(rows[1].mseRatio.lo, 10.0);
  EXPECT_GT(rows[1].mseRatio.hi, 10.0);
  EXPECT_NEAR(rows[0].timeMsMedian, 22.0, 1e-12);
  EXPECT_EQ(rows[0].timedFrames, 6u);
  // Every frame took 1.1 times as long as the interleaved frame of path, although the clock varies.
  EXPECT_NEAR(rows[1].timeRatio.value, 1.1, 1e-12);
  EXPECT_NEAR(rows[1].timeRatio.lo, 1.1, 1e-9);
  EXPECT_NEAR(rows[1].timeRatio.hi, 1.1, 1e-9);
  EXPECT_NEAR(rows[1].efficiencyRatio.value, 10.0 / 1.1, 1e-9);
  EXPECT_EQ(rows[0].mseRatio.value, 1.0);
  EXPECT_EQ(rows[0].timeRatio.value, 1.0);
}

// Passes are scaled so that bars end at the time in the table: medians do not add up to the median.
TEST_F(SummaryTest, PassesAddUpToTheTimeOfAFrame) {
  for (RunResult& run : block_.methods[1].runs)
    run.passes = {{"initial", 3.0 + run.run}, {"spatial", 1.0}};
  const auto rows = summarise(suite_, block_);
  ASSERT_EQ(rows[1].passes.size(), 2u);
  EXPECT_NEAR(rows[1].timeMsMedian, 24.2, 1e-12);
  EXPECT_NEAR(rows[1].passes[0].timeMs, 24.2 * 0.8, 1e-9) << "medians of 4 and 1";
  EXPECT_NEAR(rows[1].passes[1].timeMs, 24.2 * 0.2, 1e-9);
  EXPECT_NEAR(rows[0].passes[0].timeMs, rows[0].timeMsMedian, 1e-9);
}

TEST_F(SummaryTest, RatiosOfTimesAreGeometricMeans) {
  block_.methods[1].runs[0].timesMs = {10.0, 20.0};   // as long as path
  block_.methods[1].runs[1].timesMs = {80.0, 160.0};  // twice
  block_.methods[1].runs[2].timesMs = {48.0, 96.0};   // four times
  const Interval ratio = summarise(suite_, block_)[1].timeRatio;
  EXPECT_NEAR(ratio.value, 2.0, 1e-12);
  EXPECT_GT(ratio.lo, 0.0) << "no time is negative";
  EXPECT_NEAR(ratio.lo * ratio.hi, 4.0, 1e-9);
}

TEST_F(SummaryTest, SquaredBiasFromHalvesOfTheRuns) {
  const auto rows = summarise(suite_, block_);
  EXPECT_NEAR(rows[0].biasSquared.value, 0.0, 1e-12);
  EXPECT_NEAR(rows[1].biasSquared.value, 0.01, 1e-8) << "(1.1 - 1) squared";
  EXPECT_NEAR(rows[1].biasShare.value, 0.1, 1e-7);
  EXPECT_TRUE(rows[1].counts);
}

TEST_F(SummaryTest, BiasedRowsCountWithinBoundsOnly) {
  for (RunResult& run : block_.methods[1].runs) run.measured.energyRatio = 0.94;
  EXPECT_FALSE(summarise(suite_, block_)[1].counts);
  for (RunResult& run : block_.methods[1].runs) run.measured.energyRatio = 0.951;
  EXPECT_TRUE(summarise(suite_, block_)[1].counts);
  for (RunResult& run : block_.methods[1].runs) run.measured.mse = 0.039;  // bias^2 is 0.01
  EXPECT_FALSE(summarise(suite_, block_)[1].counts);
  for (RunResult& run : block_.methods[1].runs) run.measured.mse = 0.041;
  EXPECT_TRUE(summarise(suite_, block_)[1].counts);
  EXPECT_TRUE(summarise(suite_, block_)[1].flags.empty());
  // A parameter can make a mode that is called unbiased biased.
  suite_.methods[1].session.mode = "unbiased";
  for (RunResult& run : block_.methods[1].runs) run.measured.energyRatio = 0.94;
  suite_.methods[1].session.parameters["mis"] = std::string("confidence");
  const MethodSummary row = summarise(suite_, block_)[1];
  EXPECT_EQ(row.bias, BiasClass::biased);
  EXPECT_FALSE(row.counts);
}

// Runs leave an estimate undecided if its interval crosses a bound, inside or outside the bounds.
TEST_F(SummaryTest, BiasedRowsAreJudgedByIntervals) {
  auto& runs = block_.methods[1].runs;
  const auto setEnergies = [&](double middle, double spread) {
    for (size_t r = 0; r < 3; ++r)
      runs[r].measured.energyRatio = middle + spread * (double(r) - 1.0);
    return summarise(suite_, block_)[1];
  };
  // Student's t of three runs: the half width is 2.48 times the spread.
  for (const double middle : {1.061, 0.939, 1.0}) {
    const MethodSummary open = setEnergies(middle, 0.065);
    EXPECT_TRUE(open.counts) << middle;
    ASSERT_EQ(open.flags.size(), 1u);
    EXPECT_NE(open.flags[0].find("the runs do not decide whether its energy ratio "),
              std::string::npos)
        << open.flags[0];
    EXPECT_NE(open.flags[0].find("is inside 0.95..1.05"), std::string::npos) << open.flags[0];
  }
  EXPECT_NE(setEnergies(1.061, 0.065).flags[0].find("1.061 [0.8995, 1.222]"), std::string::npos);
  EXPECT_TRUE(setEnergies(1.0, 0.02).flags.empty());
  const MethodSummary off = setEnergies(1.061, 0.004);
  EXPECT_FALSE(off.counts);
  ASSERT_EQ(off.flags.size(), 1u);
  EXPECT_EQ(off.flags[0],
            "does not count: energy ratio 1.061 [1.051, 1.071] is outside 0.95..1.05");
  EXPECT_FALSE(setEnergies(0.939, 0.004).counts);

  // Squared bias of 0, 0.01 and 0.04 in three runs: a mean of 0.011 that depends on one of them.
  setEnergies(1.0, 0.0);
  block_.methods[1].measured = BiasRuns();
  for (const float pixel : {1.0f, 1.1f, 1.2f})
    block_.methods[1].measured.add(Image(kSide, kSide, glm::vec3(pixel)));
  const auto setMse = [&](double mse) {
    for (RunResult& run : runs) run.measured.mse = mse;
    return summarise(suite_, block_)[1];
  };
  const MethodSummary open = setMse(0.02);
  EXPECT_GT(open.biasShare.value, 0.25);
  EXPECT_LT(open.biasShare.lo, 0.25);
  EXPECT_TRUE(open.counts);
  ASSERT_EQ(open.flags.size(), 1u);
  EXPECT_NE(open.flags[0].find("the runs do not decide whether its squared bias, "),
            std::string::npos)
      << open.flags[0];
  EXPECT_TRUE(setMse(1.0).flags.empty());
  // Two runs form one pair, whose spread is unknown.
  runs.pop_back();
  block_.methods[1].measured = BiasRuns();
  for (int r = 0; r < 2; ++r) block_.methods[1].measured.add(Image(kSide, kSide, glm::vec3(1.1f)));
  const MethodSummary pair = setMse(0.02);
  EXPECT_TRUE(pair.counts);
  ASSERT_EQ(pair.flags.size(), 1u);
  EXPECT_NE(pair.flags[0].find("50 % [unknown] of its MSE"), std::string::npos) << pair.flags[0];
}

TEST_F(SummaryTest, UnbiasedRowsAreDoubtedWhereTheyContradictThemselves) {
  suite_.methods[1].session.mode = "unbiased";
  const auto setEnergies = [&](double a, double b, double c) {
    auto& runs = block_.methods[1].runs;
    runs[0].measured.energyRatio = a;
    runs[1].measured.energyRatio = b;
    runs[2].measured.energyRatio = c;
    return summarise(suite_, block_)[1];
  };
  // Squared bias of 0.01 in every run, MSE 0.1: the interval leaves out 0.
  const MethodSummary biased = setEnergies(0.90, 0.94, 0.98);
  EXPECT_TRUE(biased.counts) << "noise explains its energy; its bias is small";
  ASSERT_EQ(biased.flags.size(), 1u);
  EXPECT_EQ(biased.flags[0], "declared unbiased, but its squared bias is 10 % [10, 10] of its MSE");
  for (RunResult& run : block_.methods[1].runs) run.measured.mse = 0.039;
  EXPECT_FALSE(summarise(suite_, block_)[1].counts);

  block_.methods[1].measured = block_.methods[0].measured;  // no bias
  EXPECT_TRUE(setEnergies(0.90, 0.94, 0.98).flags.empty());
  const MethodSummary off = setEnergies(0.9401, 0.94, 0.9399);
  EXPECT_FALSE(off.counts);
  ASSERT_EQ(off.flags.size(), 1u);
  EXPECT_NE(off.flags[0].find("does not count: declared unbiased, but its energy ratio 0.94 ["),
            std::string::npos)
      << off.flags[0];
  const MethodSummary slightly = setEnergies(1.0100, 1.0101, 1.0102);
  EXPECT_TRUE(slightly.counts);
  EXPECT_EQ(slightly.flags.size(), 1u);
  // The reference's energy has an error of its own.
  block_.reference.variance = Image(kSide, kSide, glm::vec3(0.01f));
  EXPECT_TRUE(setEnergies(1.0100, 1.0101, 1.0102).flags.empty());
  EXPECT_FALSE(setEnergies(1.3000, 1.3001, 1.3002).flags.empty());
}

TEST_F(SummaryTest, NoBiasBelowTheErrorOfAnExactImage) {
  suite_.methods[1].session.mode = "unbiased";
  const auto flagsAt = [&](double difference) {
    block_.methods[1] = {};
    for (uint32_t r = 0; r < 3; ++r) {
      RunResult run = makeRun(r, difference * difference, {11.0, 22.0});
      run.measured.energyRatio = 1.0 - difference;
      addRun(1, std::move(run), float(1.0 - difference));
    }
    return summarise(suite_, block_)[1].flags.size();
  };
  const double below = std::exp2(-17.0), above = std::exp2(-16.0);  // 7.6e-6 and 1.5e-5
  EXPECT_GT(flagsAt(below), 0u) << "a rendered reference has no error that is known beforehand";
  block_.reference.metadata["truth"] = "in closed form";
  EXPECT_EQ(flagsAt(below), 0u);
  EXPECT_GT(flagsAt(above), 0u);
}

TEST_F(SummaryTest, RowsSayWhatLightTheyLeaveOut) {
  suite_.methods[1].session.integrator = "local";
  block_.methods[1].lightLeftOut = "light of more than one rough surface";
  const MethodSummary row = summarise(suite_, block_)[1];
  EXPECT_FALSE(row.counts);
  ASSERT_EQ(row.flags.size(), 1u);
  EXPECT_NE(row.flags[0].find("leaves out light of more than one rough surface; energy ratio 1 ["),
            std::string::npos)
      << row.flags[0];
}

TEST_F(SummaryTest, RowsSayWhatSolutionIsNotDone) {
  suite_.methods[1].session.integrator = "radiosity";
  suite_.methods[1].session.mode = "biased";
  suite_.methods[1].session.parameters["iterations"] = int64_t{2};
  const auto flagged = [&](const std::vector<double>& residuals) {
    for (RunResult& run : block_.methods[1].runs) run.residuals = residuals;
    const std::vector<std::string> flags = summarise(suite_, block_)[1].flags;
    return std::any_of(flags.begin(), flags.end(), [](const std::string& flag) {
      return flag.find("its solution is not done: the last of 2 iterations left 20 %") == 0;
    });
  };
  EXPECT_TRUE(flagged({0.5, 0.2}));
  EXPECT_FALSE(flagged({0.5, 0.009}));
  EXPECT_FALSE(flagged({0.5})) << "ended by max_bounces";
  EXPECT_FALSE(flagged({}));
}

// Doubted are 2 of 1000 correct rows of 8 runs with nearly normal noise, 13 with a long tail and
// few pixels.
TEST_F(SummaryTest, CorrectRowsAreNotDoubted) {
  suite_.methods[1].session.mode = "unbiased";
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const double tail : {0.1, 1.0}) {
    size_t doubted = 0;
    for (int set = 0; set < 1000; ++set) {
      block_.methods[1] = {};
      for (uint32_t r = 0; r < 8; ++r) {
        RunResult run = makeRun(r, 0.1, {1.0, 1.0});
        // Log-normal with mean 1.
        run.measured.energyRatio = std::exp(tail * normal(random) - 0.5 * tail * tail);
        block_.methods[1].runs.push_back(std::move(run));
        Image image(kSide, kSide);
        for (glm::vec3& pixel : image.pixels) {
          for (int c = 0; c < 3; ++c)
            pixel[c] = float(std::exp(tail * normal(random) - 0.5 * tail * tail));
        }
        block_.methods[1].measured.add(image);
      }
      doubted += summarise(suite_, block_)[1].flags.empty() ? 0 : 1;
    }
    std::printf("tail %g: %zu of 1000 doubted\n", tail, doubted);
    EXPECT_LE(doubted, tail < 0.5 ? 6u : 25u);
  }
}

TEST_F(SummaryTest, OneRunHasNoIntervalAndItsBiasIsUnknown) {
  for (MethodResult& method : block_.methods) {
    method.runs.resize(1);
    method.measured = BiasRuns();
    method.measured.add(Image(kSide, kSide, glm::vec3(1.0f)));
  }
  const auto rows = summarise(suite_, block_);
  EXPECT_TRUE(std::isnan(rows[1].mse.lo));
  EXPECT_TRUE(std::isnan(rows[1].biasSquared.value));
  EXPECT_FALSE(rows[1].counts) << "a biased row of unknown bias does not count";
  EXPECT_NEAR(rows[1].mseRatio.value, 8.0, 1e-12);
}

TEST_F(SummaryTest, FlagsFirefliesAndNonfiniteValues) {
  for (RunResult& run : block_.methods[1].runs) run.measured.worstShare = 0.6;
  auto rows = summarise(suite_, block_);
  ASSERT_EQ(rows[1].flags.size(), 1u);
  EXPECT_NE(rows[1].flags[0].find("60 %"), std::string::npos);
  block_.methods[0].runs[1].measured.nonfinite = 2;
  block_.methods[0].runs[0].health.health.counts[rl::RL_HEALTH_NONFINITE] = 3;
  rows = summarise(suite_, block_);
  EXPECT_EQ(rows[0].nonfinite, 5u);
  EXPECT_FALSE(rows[0].counts);
}

TEST_F(SummaryTest, WithoutBaselineRatiosAreUnknown) {
  suite_.methods[0].session.integrator = "restir_gi";
  const auto rows = summarise(suite_, block_);
  EXPECT_TRUE(std::isnan(rows[1].mseRatio.value));
  EXPECT_NE(summaryCsv(rows).find(",nan,"), std::string::npos);
}

// The same two methods on a second backend, three times as fast and a little noisier.
TEST_F(SummaryTest, RatiosStayWithinABackend) {
  for (size_t m = 0; m < 2; ++m) {
    SuiteMethod method = suite_.methods[m];
    suite_.methods[m].base = method.base = method.name;
    suite_.methods[m].name += " @cpu";
    method.name += " @vulkan";
    method.session.backend = "vulkan";
    suite_.methods.push_back(method);
    MethodResult result = block_.methods[m];
    for (RunResult& run : result.runs) {
      run.measured.mse *= m == 0 ? 2.0 : 1.0;
      for (double& timeMs : run.timesMs) timeMs /= 3.0;
    }
    block_.methods.push_back(std::move(result));
  }
  const auto rows = summarise(suite_, block_);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NEAR(rows[1].mseRatio.value, 10.0, 1e-12);
  EXPECT_NEAR(rows[3].mseRatio.value, 20.0, 1e-12) << "against path @vulkan";
  EXPECT_NEAR(rows[3].timeRatio.value, 1.1, 1e-12);
  EXPECT_EQ(rows[2].timeRatio.value, 1.0);
  EXPECT_TRUE(rows[0].isBaseline && rows[2].isBaseline);
  EXPECT_FALSE(rows[1].isBaseline || rows[3].isBaseline);
  EXPECT_TRUE(std::isnan(rows[0].timeToFirstBackend.value));
  EXPECT_TRUE(std::isnan(rows[1].timeToFirstBackend.value));
  EXPECT_NEAR(rows[2].timeToFirstBackend.value, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(rows[3].timeToFirstBackend.value, 1.0 / 3.0, 1e-12);
  const std::string table = blockTable(suite_, rows);
  EXPECT_NE(table.find("| time / cpu |"), std::string::npos) << table;
  EXPECT_NE(table.find(" 0.333x [0.333, 0.333] |"), std::string::npos) << table;
  // A backend without its baseline has no ratios, but is still compared with the first backend.
  block_.methods[2].runs.clear();
  const auto fewer = summarise(suite_, block_);
  ASSERT_EQ(fewer.size(), 3u);
  EXPECT_TRUE(std::isnan(fewer[2].mseRatio.value));
  EXPECT_NEAR(fewer[2].timeToFirstBackend.value, 1.0 / 3.0, 1e-12);
}

// Adds the average of the baseline's frames as a third method: 0.02 in every run.
TEST_F(SummaryTest, RowsAreComparedWithTheAverageOfPathsFrames) {
  SuiteMethod method = suite_.methods[0];
  method.name = "path + accumulate";
  method.session.denoiser = "accumulate";
  suite_.methods.push_back(method);
  block_.methods.resize(3);
  for (uint32_t run = 0; run < 3; ++run) {
    addRun(2, makeRun(run, 0.02, {10.0, 20.0}), 1.0f);
    for (size_t m = 0; m < 3; ++m) {
      // MSE by age: path 1, gi 0.5 / age, average 1 / age.
      for (const uint32_t age : {1u, 4u}) {
        AgedError aged;
        aged.age = age;
        aged.timeMs = m == 1 ? 15.0 : 10.0;
        aged.error.mse = (m == 0 ? 1.0 : m == 1 ? 0.5 : age == 1 ? 1.0 : 0.25) / (m == 1 ? age : 1);
        block_.methods[m].runs[run].aged.push_back(aged);
      }
    }
  }
  const auto rows = summarise(suite_, block_);
  EXPECT_TRUE(rows[0].isBaseline && rows[2].isAverage);
  EXPECT_FALSE(rows[1].isBaseline || rows[1].isAverage || rows[2].isBaseline);
  EXPECT_NEAR(rows[0].ratioToAverage.value, 0.02, 1e-12);
  EXPECT_NEAR(rows[1].ratioToAverage.value, 0.2, 1e-12);
  EXPECT_TRUE(std::isnan(rows[2].ratioToAverage.value));
  ASSERT_EQ(rows[1].ages.size(), 2u);
  EXPECT_EQ(rows[1].ages[1].age, 4u);
  EXPECT_NEAR(rows[1].ages[0].mseRatio.value, 2.0, 1e-12);
  EXPECT_NEAR(rows[1].ages[1].mseRatio.value, 8.0, 1e-12);
  EXPECT_NEAR(rows[1].ages[0].ratioToAverage.value, 2.0, 1e-12);
  EXPECT_NEAR(rows[1].ages[1].ratioToAverage.value, 2.0, 1e-12);
  EXPECT_NEAR(rows[1].ages[1].timeRatio.value, 1.5, 1e-12);
  EXPECT_NEAR(rows[2].ages[1].mseRatio.value, 4.0, 1e-12);
  const std::string table = blockTable(suite_, rows), csv = summaryCsv(rows);
  EXPECT_NE(table.find("| than path | than path + accumulate | energy |"), std::string::npos)
      << table;
  EXPECT_NE(table.find("| frame | gi | path + accumulate |"), std::string::npos) << table;
  EXPECT_NE(table.find("| 4 | 8 [8, 8] | 4 [4, 4] |"), std::string::npos) << table;
  EXPECT_NE(csv.find("average_mse_ratio"), std::string::npos);
  // A suite without that row has no such column.
  suite_.methods.pop_back();
  block_.methods.pop_back();
  EXPECT_EQ(blockTable(suite_, summarise(suite_, block_)).find("accumulate"), std::string::npos);
}

// A row against itself is exactly 1, whatever its spread; an end not above 0 leaves a ratio
// unbounded.
TEST_F(SummaryTest, RatiosAreThoseOfErrors) {
  auto& runs = block_.methods[0].runs;
  for (size_t r = 0; r < 3; ++r) runs[r].measured.mse = r == 1 ? 30.0 : 0.1;
  auto& others = block_.methods[1].runs;
  for (size_t r = 0; r < 3; ++r) others[r].measured.mse = r == 1 ? 0.1 : 0.12;
  const auto rows = summarise(suite_, block_);
  for (const Interval& own : {rows[0].mseRatio, rows[0].efficiencyRatio}) {
    EXPECT_EQ(own.value, 1.0);
    EXPECT_EQ(own.lo, 1.0);
    EXPECT_EQ(own.hi, 1.0);
  }
  EXPECT_EQ(rows[1].mseRatio.lo, -std::numeric_limits<double>::infinity());
  EXPECT_GT(rows[1].mseRatio.hi, rows[1].mseRatio.value);
}

TEST_F(SummaryTest, OneBackendHasNoColumnForOthers) {
  EXPECT_EQ(blockTable(suite_, summarise(suite_, block_)).find("time / "), std::string::npos);
}

TEST_F(SummaryTest, UnfinishedMethodsAreLeftOut) {
  block_.methods[1].runs.clear();
  EXPECT_EQ(summarise(suite_, block_).size(), 1u);
}

TEST_F(SummaryTest, CsvQuotesWhatNeedsIt) {
  suite_.methods[1].name = "a \"b\", c";
  const std::string csv = summaryCsv(summarise(suite_, block_));
  EXPECT_NE(csv.find("\"a \"\"b\"\", c\""), std::string::npos) << csv;
}

// Sets errors after 1, 2, 4, 8 frames, almost the same in every run.
void accumulate(MethodResult& method, const std::vector<double>& mse, double frameMs) {
  for (RunResult& run : method.runs) {
    run.accumulated.clear();
    for (size_t k = 0; k < mse.size(); ++k) {
      AccumulatedError point;
      point.frames = 1u << k;
      point.timeMs = frameMs * double(point.frames);
      point.error.mse = mse[k] * (1.0 + 1e-3 * double(run.run));
      run.accumulated.push_back(point);
    }
  }
}

bool hasFlag(const MethodSummary& row, const std::string& text) {
  return std::any_of(row.flags.begin(), row.flags.end(),
                     [&](const std::string& flag) { return flag.find(text) != std::string::npos; });
}

TEST_F(SummaryTest, AccumulatedErrorsSayWhatWasReadOffTheirLines) {
  accumulate(block_.methods[0], {8.0, 4.0, 2.0, 1.0}, 10.0);
  accumulate(block_.methods[1], {4.0, 2.0, 1.0, 0.5}, 10.0);
  auto rows = summarise(suite_, block_);
  std::string table = blockTable(suite_, rows);
  EXPECT_NE(table.find("| 4 of 4 points, up to 1.00x off | 2.00x lower"), std::string::npos)
      << table;
  EXPECT_TRUE(rows[1].flags.empty()) << rows[1].flags[0];
  // The method stops improving after two frames, the line does not.
  accumulate(block_.methods[1], {4.0, 2.0, 2.0, 2.0}, 10.0);
  rows = summarise(suite_, block_);
  EXPECT_TRUE(hasFlag(rows[1], "do not lie on a line: up to 1.32x off"));
  EXPECT_TRUE(hasFlag(rows[1], "at equal time 2.00x higher")) << "8 frames each: 2 over 1";
  // No error was measured for both.
  accumulate(block_.methods[1], {0.4, 0.2, 0.1, 0.05}, 10.0);
  rows = summarise(suite_, block_);
  EXPECT_TRUE(hasFlag(rows[1], "nothing to equal error: outside the measured range"));
  table = blockTable(suite_, rows);
  EXPECT_NE(table.find("20.0x lower"), std::string::npos) << table;
  EXPECT_EQ(table.find("x faster"), std::string::npos) << table;
  EXPECT_NE(summaryCsv(rows).find("accumulated_points_fitted"), std::string::npos);
}

TEST_F(SummaryTest, ErrorsInTheNoiseOfTheReferenceAreNotFitted) {
  accumulate(block_.methods[0], {8.0, 4.0, 2.0, 1.0}, 10.0);
  // Halves 4 apart: a deviation of 8 / sqrt(3) per pixel, 1.15 over 16 pixels, four times that is
  // 4.6.
  block_.reference.half0 = Image(kSide, kSide, glm::vec3(3.0f));
  block_.reference.half1 = Image(kSide, kSide, glm::vec3(-1.0f));
  const auto rows = summarise(suite_, block_);
  EXPECT_EQ(rows[0].convergence->fitted(), 1u);
  block_.reference.half0 = Image(kSide, kSide, glm::vec3(2.0f));
  block_.reference.half1 = Image(kSide, kSide, glm::vec3(0.0f));
  const auto more = summarise(suite_, block_);
  EXPECT_EQ(more[0].convergence->fitted(), 3u) << "a quarter of that: 1.15 leaves 8, 4, 2";
  EXPECT_NE(blockTable(suite_, more).find("(not 8 frames)"), std::string::npos);
}

TEST_F(SummaryTest, TemporalFiguresHaveIntervals) {
  for (RunResult& run : block_.methods[1].runs) {
    run.temporal.emplace();
    run.temporal->variance = 1.0 + double(run.run);
    run.temporal->errorDifferenceSquared = 2.0;
    run.temporal->autocorrelation[0] = 0.5 + 0.1 * double(run.run);
    run.temporal->referenceDifference = 1.0;
    run.temporal->referenceDifferenceNoise = 0.04;
  }
  auto rows = summarise(suite_, block_);
  EXPECT_FALSE(rows[0].temporal.has_value());
  ASSERT_TRUE(rows[1].temporal.has_value());
  EXPECT_NEAR(rows[1].temporal->variance.value, 2.0, 1e-12);
  EXPECT_NEAR(rows[1].temporal->variance.hi, 2.0 + 4.303 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(rows[1].temporal->autocorrelation[0].value, 0.6, 1e-12);
  EXPECT_LT(rows[1].temporal->autocorrelation[0].lo, 0.5);
  EXPECT_TRUE(rows[1].flags.empty());
  const std::string csv = summaryCsv(rows), table = blockTable(suite_, rows);
  for (const char* column : {"temporal_variance_ci_lo", "error_autocorrelation_8_ci_hi",
                             "temporal_error_difference_squared_ci_hi"})
    EXPECT_NE(csv.find(column), std::string::npos) << column;
  EXPECT_NE(table.find("| gi | 2 [-0.484, 4.48] |"), std::string::npos) << table;
  for (RunResult& run : block_.methods[1].runs) run.temporal->referenceDifferenceNoise = 0.06;
  rows = summarise(suite_, block_);
  EXPECT_TRUE(hasFlag(rows[1], "up to 6 % is their noise"));
}

}  // namespace

}  // namespace restlab
