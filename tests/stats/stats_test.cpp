// Statistics against SciPy 1.10 (chisquare, ttest_ind, ttest_1samp, kstwo and its exact form
// _kolmogn_DMTW for n = 400, nct, norm), and their behaviour: p-values uniform under the null
// hypothesis, impossible events, degenerate input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "experiments/statistics/chi2.h"
#include "experiments/statistics/holm.h"
#include "tests/stats/ks.h"
#include "experiments/statistics/power.h"
#include "experiments/statistics/tost.h"
#include "experiments/statistics/welch.h"

namespace restlab::stats {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::vector<double> kA = {3.1, 2.9, 3.4, 3.0, 3.3, 2.7, 3.2, 3.05};
const std::vector<double> kB = {3.0, 2.8, 3.4, 3.1, 3.24, 2.62};

TEST(Chi2, KnownValue) {
  const std::vector<uint64_t> counts = {18, 22, 30, 30};
  const std::vector<double> probabilities(4, 0.25);
  const Chi2Result r = chi2Test(counts, probabilities, 100);
  EXPECT_NEAR(r.statistic, 4.32, 1e-12);
  EXPECT_EQ(r.dof, 3.0);
  EXPECT_NEAR(r.pValue, 0.22891886433610517, 1e-12);
  EXPECT_EQ(r.failures, 0u);
}

TEST(Chi2, FailedSamplesAreACell) {
  // The pdf predicts 20 failures of 100; 30 occur.
  const std::vector<uint64_t> counts = {17, 18, 17, 18};
  const std::vector<double> probabilities(4, 0.2);
  const Chi2Result r = chi2Test(counts, probabilities, 100);
  EXPECT_NEAR(r.statistic, (9.0 + 4.0 + 9.0 + 4.0 + 100.0) / 20.0, 1e-12);
  EXPECT_EQ(r.dof, 4.0);
  EXPECT_EQ(r.failures, 30u);
  // Failures are rejected if the pdf integrates to 1, even if no single cell looks wrong.
  const std::vector<double> full(4, 0.25);
  const std::vector<uint64_t> lost = {225, 225, 225, 225};
  EXPECT_LT(chi2Test(lost, full, 1000).pValue, 1e-5);
}

TEST(Chi2, ImpossibleEventsReject) {
  const std::vector<uint64_t> counts = {500000, 500000, 1};
  const std::vector<double> probabilities = {0.5, 0.5, 0.0};
  const Chi2Result r = chi2Test(counts, probabilities, 1000001);
  EXPECT_TRUE(r.impossible);
  EXPECT_EQ(r.pValue, 0.0);
  const std::vector<uint64_t> even = {50, 50};
  const std::vector<double> excess = {0.52, 0.52};
  EXPECT_TRUE(chi2Test(even, excess, 100).excess);
  EXPECT_EQ(chi2Test(even, excess, 100).pValue, 0.0);
}

TEST(Chi2, PoolsSmallCellsAndRefusesNonsense) {
  // Expected 1, 2, 3 pool to 6; 94 stays.
  const std::vector<uint64_t> counts = {0, 3, 3, 94};
  const std::vector<double> probabilities = {0.01, 0.02, 0.03, 0.94};
  const Chi2Result r = chi2Test(counts, probabilities, 100);
  EXPECT_EQ(r.dof, 1.0);
  EXPECT_NEAR(r.statistic, 0.0, 1e-12);
  // A pool below 5 takes the next cell: 2 + 8.
  const std::vector<uint64_t> two = {2, 8, 90};
  const std::vector<double> twoP = {0.02, 0.08, 0.90};
  EXPECT_EQ(chi2Test(two, twoP, 100).dof, 1.0);
  EXPECT_THROW(chi2Test(two, probabilities, 100), std::invalid_argument);
  EXPECT_THROW(chi2Test(two, twoP, 99), std::invalid_argument);
  EXPECT_THROW(chi2Test(std::vector<uint64_t>{7}, std::vector<double>{1.0}, 7),
               std::invalid_argument);
  EXPECT_THROW(chi2Test(two, std::vector<double>{-0.1, 0.2, 0.9}, 100), std::invalid_argument);
  EXPECT_THROW(chi2Test(two, std::vector<double>{std::nan(""), 0.2, 0.8}, 100),
               std::invalid_argument);
}

TEST(Summarise, KnownValues) {
  const Sample s = summarise(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(s.n, 8.0);
  EXPECT_EQ(s.mean, 5.0);
  EXPECT_NEAR(s.variance, 32.0 / 7.0, 1e-15);
}

// Quantiles from textbook tables, tails of one and two degrees of freedom in closed form.
TEST(Student, TablesAndClosedForms) {
  const struct {
    double dof, at95, at975, at9995;
  } table[] = {{1.0, 6.314, 12.706, 636.619},   {2.0, 2.920, 4.303, 31.599},
               {5.0, 2.015, 2.571, 6.869},      {10.0, 1.812, 2.228, 4.587},
               {30.0, 1.697, 2.042, 3.646},     {120.0, 1.658, 1.980, 3.373},
               {kInfinity, 1.645, 1.960, 3.291}};
  for (const auto& row : table) {
    EXPECT_NEAR(studentQuantile(0.95, row.dof), row.at95, 5.1e-4) << row.dof;
    EXPECT_NEAR(studentQuantile(0.975, row.dof), row.at975, 5.1e-4) << row.dof;
    EXPECT_NEAR(studentQuantile(0.9995, row.dof), row.at9995, 5.1e-4) << row.dof;
    EXPECT_NEAR(studentQuantile(0.025, row.dof), -row.at975, 5.1e-4) << row.dof;
    EXPECT_NEAR(studentUpper(studentQuantile(0.9, row.dof), row.dof), 0.1, 1e-12) << row.dof;
  }
  for (const double t : {-3.0, -0.5, 0.0, 0.7, 2.0, 40.0}) {
    const double one = 0.5 - std::atan(t) / std::acos(-1.0);
    const double two = 0.5 * (1.0 - t / std::sqrt(t * t + 2.0));
    EXPECT_NEAR(studentUpper(t, 1.0), one, 1e-14) << t;
    EXPECT_NEAR(studentUpper(t, 2.0), two, 1e-14) << t;
    EXPECT_NEAR(studentTwoSided(t, 2.0), 2.0 * std::min(two, 1.0 - two), 1e-14) << t;
    EXPECT_NEAR(studentUpper(t, kInfinity), 0.5 * std::erfc(t / std::sqrt(2.0)), 1e-15) << t;
  }
  EXPECT_EQ(studentUpper(kInfinity, 3.0), 0.0);
  EXPECT_EQ(studentUpper(-kInfinity, 3.0), 1.0);
  EXPECT_TRUE(std::isnan(studentUpper(std::nan(""), 3.0)));
}

TEST(Welch, KnownValues) {
  const WelchResult r = welchTest(summarise(kA), summarise(kB));
  EXPECT_NEAR(r.t, 0.3875592806077372, 1e-9);
  EXPECT_NEAR(r.dof, 9.254545645430266, 1e-9);
  EXPECT_NEAR(r.pValue, 0.7071053944939399, 1e-9);
  // Against a constant, Welch's test is the one-sample t-test.
  const WelchResult one = welchTest(summarise(kA), {1.0, 3.0, 0.0});
  EXPECT_NEAR(one.t, 1.0281993596310308, 1e-9);
  EXPECT_NEAR(one.dof, 7.0, 1e-12);
  EXPECT_NEAR(one.pValue, 0.33806790019020316, 1e-9);
  EXPECT_NEAR(studentTwoSided(3.2905267314919255, kInfinity), 1e-3, 1e-12);
}

TEST(Welch, DegenerateInput) {
  EXPECT_EQ(welchTest({5, 2.0, 0.0}, {1, 2.0, 0.0}).pValue, 1.0);
  EXPECT_EQ(welchTest({5, 2.0, 0.0}, {1, 1.0, 0.0}).pValue, 0.0);
  EXPECT_EQ(welchTest({5, 2.0, 0.0}, {1, 1.0, 0.0}).t, kInfinity);
  EXPECT_TRUE(std::isnan(welchTest({5, std::nan(""), 1.0}, {1, 1.0, 0.0}).pValue));
  EXPECT_TRUE(std::isnan(welchTest({5, kInfinity, 1.0}, {1, 1.0, 0.0}).pValue));
  EXPECT_THROW(welchTest({1, 2.0, 1.0}, {1, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(welchTest({5, 2.0, -1.0}, {1, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(summarise(std::vector<double>{1.0}), std::invalid_argument);
}

TEST(Tost, KnownValues) {
  const TostResult r = tostTest(summarise(kA), summarise(kB), 0.2);
  EXPECT_NEAR(r.pLower, 0.05160487655261841, 1e-9);
  EXPECT_NEAR(r.pUpper, 0.1640312397979003, 1e-9);
  EXPECT_EQ(r.pValue, r.pUpper);
  EXPECT_NEAR(r.lo, -0.2027837282135323, 1e-9);
  EXPECT_NEAR(r.hi, 0.31195039488019827, 1e-9);
  EXPECT_EQ(tostTest({3, 1.0, 0.0}, {1, 1.1, 0.0}, 0.2).pValue, 0.0);
  EXPECT_EQ(tostTest({3, 1.0, 0.0}, {1, 1.3, 0.0}, 0.2).pValue, 1.0);
  EXPECT_TRUE(std::isnan(tostTest({3, std::nan(""), 1.0}, {1, 1.3, 0.0}, 0.2).pValue));
  EXPECT_THROW(tostTest(summarise(kA), summarise(kB), 0.0), std::invalid_argument);
}

// Two degrees of freedom, in closed form: three observations of variance 3 have a standard error of
// 1, and Student's t of p is (2 p - 1) sqrt(1 / (2 p (1 - p))).
TEST(Tost, ClosedFormAtOtherLevels) {
  const auto upper = [](double t) { return 0.5 * (1.0 - t / std::sqrt(t * t + 2.0)); };
  for (const double difference : {-0.5, 0.0, 1.5}) {
    for (const double alpha : {0.025, 0.1}) {
      const TostResult r = tostTest({3.0, 2.0 + difference, 3.0}, {1.0, 2.0, 0.0}, 2.0, alpha);
      EXPECT_NEAR(r.dof, 2.0, 1e-14);
      EXPECT_NEAR(r.pLower, upper(difference + 2.0), 1e-14);
      EXPECT_NEAR(r.pUpper, upper(2.0 - difference), 1e-14);
      const double half = (1.0 - 2.0 * alpha) / std::sqrt(2.0 * alpha * (1.0 - alpha));
      EXPECT_NEAR(r.lo, difference - half, 1e-12);
      EXPECT_NEAR(r.hi, difference + half, 1e-12);
    }
  }
  for (const double alpha : {0.0, 0.5}) {
    EXPECT_THROW(tostTest({3.0, 2.0, 3.0}, {1.0, 2.0, 0.0}, 2.0, alpha), std::invalid_argument);
  }
}

TEST(Tost, IntervalInsideMarginsExactlyWhenEquivalent) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int equivalent = 0;
  for (int e = 0; e < 300; ++e) {
    std::vector<double> a(10), b(14);
    for (double& x : a) x = normal(random);
    for (double& x : b) x = normal(random);
    const TostResult r = tostTest(summarise(a), summarise(b), 0.9);
    EXPECT_EQ(r.pValue<0.05, r.lo> - 0.9 && r.hi < 0.9);
    equivalent += r.pValue < 0.05 ? 1 : 0;
  }
  EXPECT_GT(equivalent, 30);
  EXPECT_LT(equivalent, 270);
}

TEST(Holm, KnownValues) {
  // Sorted 0.01, 0.02, 0.03, 0.04 times 4, 3, 2, 1, made monotone: 0.04, 0.06, 0.06, 0.06.
  const std::vector<double> p = {0.03, 0.01, 0.04, 0.02};
  const std::vector<double> adjusted = holmAdjusted(p);
  const double wanted[] = {0.06, 0.04, 0.06, 0.06};
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], wanted[i], 1e-15);
  EXPECT_EQ(holmReject(p, 0.05), (std::vector<bool>{false, true, false, false}));
  EXPECT_EQ(holmReject(p, 0.061), (std::vector<bool>{true, true, true, true}));
  EXPECT_TRUE(holmAdjusted({}).empty());
  EXPECT_EQ(holmAdjusted(std::vector<double>{0.9, 0.8}), (std::vector<double>{1.0, 1.0}));
  EXPECT_THROW(holmAdjusted(std::vector<double>{std::nan("")}), std::invalid_argument);
  EXPECT_THROW(holmAdjusted(std::vector<double>{1.1}), std::invalid_argument);
}

// 20000 families of 10 true hypotheses at 5 %: 5 % have a rejection (standard error 0.15 %).
TEST(Holm, HoldsTheFamilyError) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  int families = 0;
  for (int e = 0; e < 20000; ++e) {
    std::vector<double> p(10);
    for (double& x : p) x = uniform(random);
    bool any = false;
    for (const bool r : holmReject(p, 0.05)) any = any || r;
    families += any ? 1 : 0;
  }
  EXPECT_NEAR(families / 20000.0, 1.0 - std::pow(1.0 - 0.005, 10), 0.006);
}

TEST(Ks, KnownValues) {
  EXPECT_NEAR(ksUpperTail(0.3, 5), 0.664, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.9, 3), 0.002, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.274, 10), 0.3715203845434957, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.2, 20), 0.352720173623415, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.1, 100), 0.2526927570063874, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.136, 100), 0.044860299790847456, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.05, 400), 0.26121260292565424, 1e-12);
  EXPECT_NEAR(ksUpperTail(0.04, 1000), 0.07933956059000224, 5e-4);
  EXPECT_NEAR(ksUniformTest(std::vector<double>{0.1, 0.5, 0.6}).statistic, 0.4, 1e-15);
  EXPECT_EQ(ksUpperTail(1.0, 10), 0.0);
  EXPECT_EQ(ksUpperTail(0.0, 10), 1.0);
  EXPECT_THROW(ksUniformTest({}), std::invalid_argument);
  EXPECT_THROW(ksUniformTest(std::vector<double>{1.5}), std::invalid_argument);
}

TEST(Ks, FindsWhatIsNotUniform) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> good(300), squared(300);
  for (double& x : good) x = uniform(random);
  for (double& x : squared) x = std::pow(uniform(random), 2.0);
  EXPECT_GT(ksUniformTest(good).pValue, 1e-3);
  EXPECT_LT(ksUniformTest(squared).pValue, 1e-6);
}

TEST(Power, KnownValues) {
  // Noncentralities by root finding on scipy.stats.nct.
  EXPECT_NEAR(smallestDetectableShift(1.0, 31.0, 1e-3, 0.9), 5.015796135242354, 1e-8);
  EXPECT_NEAR(smallestDetectableShift(1.0, 7.0, 0.05, 0.8), 3.2697598397590584, 1e-8);
  EXPECT_NEAR(smallestDetectableShift(2.0, 62.5, 1e-3 / 64.0, 0.9), 2.0 * 6.055145623054252, 1e-8);
  EXPECT_NEAR(smallestDetectableShift(1.0, kInfinity, 1e-3, 0.9), 4.572078297036526, 1e-6);
  EXPECT_NEAR(testPower(0.0, 1.0, 12.0, 0.01), 0.01, 1e-9);
  // Cohen's table: two groups of 64, half a deviation apart, at 5 %.
  EXPECT_NEAR(testPower(0.5, std::sqrt(2.0 / 64.0), 126.0, 0.05), 0.80, 0.005);
  EXPECT_NEAR(testPower(-0.5, std::sqrt(2.0 / 64.0), 126.0, 0.05), 0.80, 0.005);
  // Known deviation: two tails of the normal distribution.
  const auto normalUpper = [](double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); };
  const double z = 1.959963984540054;
  EXPECT_NEAR(testPower(1.0, 0.5, kInfinity, 0.05), normalUpper(z - 2.0) + normalUpper(z + 2.0),
              1e-12);
  EXPECT_THROW(smallestDetectableShift(0.0, 5.0, 0.05, 0.9), std::invalid_argument);
  EXPECT_THROW(smallestDetectableShift(1.0, 5.0, 0.05, 1.0), std::invalid_argument);
  EXPECT_THROW(testPower(1.0, 1.0, 0.0, 0.05), std::invalid_argument);
  EXPECT_THROW(testPower(1.0, 1.0, 5.0, 0.0), std::invalid_argument);
}

// Under the null hypothesis the p-values of every test are uniform: 400 experiments each, by
// Kolmogorov-Smirnov.
TEST(Null, PValuesAreUniform) {
  std::mt19937_64 random(23);
  std::normal_distribution<double> normal;
  std::vector<double> welch, oneSample, chi2;
  for (int e = 0; e < 400; ++e) {
    std::vector<double> a(12), b(30);
    for (double& x : a) x = 1.0 + 3.0 * normal(random);
    for (double& x : b) x = 1.0 + normal(random);
    welch.push_back(welchTest(summarise(a), summarise(b)).pValue);
    oneSample.push_back(welchTest(summarise(a), {1.0, 1.0, 0.0}).pValue);
    // 21 equal cells, the last of which counts as failed.
    std::vector<uint64_t> counts(20, 0);
    for (int s = 0; s < 21 * 200; ++s) {
      std::uniform_int_distribution<int> cell(0, 20);
      const int c = cell(random);
      if (c < 20) ++counts[size_t(c)];
    }
    chi2.push_back(chi2Test(counts, std::vector<double>(20, 1.0 / 21.0), 21 * 200).pValue);
  }
  EXPECT_GT(ksUniformTest(welch).pValue, 1e-3);
  EXPECT_GT(ksUniformTest(oneSample).pValue, 1e-3);
  EXPECT_GT(ksUniformTest(chi2).pValue, 1e-3);
}

// The measured power is what testPower states (standard error 0.8 %).
TEST(Power, StatedPowerIsMeasured) {
  std::mt19937_64 random(29);
  std::normal_distribution<double> normal;
  const double shift = smallestDetectableShift(1.0 / std::sqrt(16.0), 15.0, 0.01, 0.9);
  int found = 0;
  for (int e = 0; e < 1500; ++e) {
    std::vector<double> a(16);
    for (double& x : a) x = shift + normal(random);
    found += welchTest(summarise(a), {1.0, 0.0, 0.0}).pValue <= 0.01 ? 1 : 0;
  }
  EXPECT_NEAR(found / 1500.0, 0.9, 0.025);
}

}  // namespace
}  // namespace restlab::stats
