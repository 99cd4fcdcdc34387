// Intervals against SciPy (Fieller's by solving |t(q)| = t_crit for q), and their coverage.
#include "core/image/intervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace restlab {
namespace {

const std::vector<double> kA = {3.1, 2.9, 3.4, 3.0, 3.3, 2.7, 3.2, 3.05};
const std::vector<double> kB = {1.5, 1.4, 1.7, 1.55, 1.62, 1.31};

void expectInterval(const Interval& interval, double value, double lo, double hi) {
  EXPECT_NEAR(interval.value, value, 1e-12);
  EXPECT_NEAR(interval.lo, lo, 1e-10);
  EXPECT_NEAR(interval.hi, hi, 1e-10);
}

TEST(Intervals, KnownValues) {
  expectInterval(meanInterval(kA), 3.08125, 2.8943935128849616, 3.268106487115038);
  expectInterval(ratioInterval(kA, kB), 2.036068281938326, 1.837541906137455, 2.2656083316177296);
  expectInterval(pairedRatioInterval(std::vector<double>(kA.begin(), kA.begin() + 6), kB),
                 2.0264317180616738, 1.9735420971296276, 2.0849343109802434);
}

// By a solution of (a - q b)^2 = t^2 (va - 2 q vab + q^2 vb) + z^2 (sa - 2 q sab + q^2 sb) for q.
TEST(Intervals, SharedNoiseWidens) {
  const double z = 1.959963984540054;
  expectInterval(widened({1.0, 0.7, 1.4}, 0.01), 1.0, 1.0 - std::hypot(0.3, 0.1 * z),
                 1.0 + std::hypot(0.4, 0.1 * z));
  EXPECT_TRUE(std::isnan(widened({1.0, std::nan(""), 1.4}, 0.01).lo));
  const std::vector<double> constant = {2.0, 2.0, 2.0}, four = {4.0, 4.0};
  const SharedNoise noise = {0.09, 0.04, 0.03};
  // (2 - 4 q)^2 = z^2 (0.09 - 0.06 q + 0.04 q^2), for runs without a spread.
  const double zz = z * z, a = 16.0 - 0.04 * zz, b = 8.0 - 0.03 * zz, c = 4.0 - 0.09 * zz;
  const double root = std::sqrt(b * b - a * c);
  expectInterval(ratioInterval(constant, four, noise), 0.5, (b - root) / a, (b + root) / a);
  const std::vector<double> fours = {4.0, 4.0, 4.0};
  expectInterval(pairedRatioInterval(constant, fours, noise), 0.5, (b - root) / a, (b + root) / a);
  // What moves both alike moves no ratio of equals.
  expectInterval(pairedRatioInterval(kB, kB, {0.04, 0.04, 0.04}), 1.0, 1.0, 1.0);
  EXPECT_LT(ratioInterval(kA, kB, noise).lo, ratioInterval(kA, kB).lo);
  EXPECT_GT(ratioInterval(kA, kB, noise).hi, ratioInterval(kA, kB).hi);
}

TEST(Intervals, TooFewRunsHaveNoWidth) {
  const std::vector<double> one = {2.0};
  EXPECT_EQ(meanInterval(one).value, 2.0);
  EXPECT_TRUE(std::isnan(meanInterval(one).lo));
  EXPECT_TRUE(std::isnan(ratioInterval(one, kB).hi));
  EXPECT_TRUE(std::isnan(ratioInterval(kA, one).hi));
  EXPECT_TRUE(std::isnan(pairedRatioInterval(one, one).lo));
  EXPECT_THROW(meanInterval({}), std::invalid_argument);
  EXPECT_THROW(ratioInterval(kA, {}), std::invalid_argument);
  EXPECT_THROW(pairedRatioInterval(kA, kB), std::invalid_argument);
}

TEST(Intervals, DegenerateInput) {
  const std::vector<double> constant = {2.0, 2.0, 2.0}, four = {4.0, 4.0};
  expectInterval(meanInterval(constant), 2.0, 2.0, 2.0);
  expectInterval(ratioInterval(constant, four), 0.5, 0.5, 0.5);
  expectInterval(pairedRatioInterval(constant, constant), 1.0, 1.0, 1.0);
  // A denominator that may be 0 bounds nothing.
  const std::vector<double> aroundZero = {-1.0, 1.2, 0.3, -0.4};
  EXPECT_EQ(ratioInterval(kA, aroundZero).lo, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(ratioInterval(kA, aroundZero).hi, std::numeric_limits<double>::infinity());
  const std::vector<double> bad = {1.0, std::nan(""), 2.0};
  EXPECT_TRUE(std::isnan(meanInterval(bad).lo));
  EXPECT_TRUE(std::isnan(ratioInterval(kA, bad).hi));
}

TEST(Intervals, MedianAndPercentile) {
  EXPECT_EQ(median(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median(std::vector<double>{4.0, 1.0, 2.0, 3.0}), 2.5);
  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i) hundred.push_back(i);
  EXPECT_EQ(percentile(hundred, 0.95), 95.0);
  EXPECT_EQ(percentile(hundred, 1.0), 100.0);
  EXPECT_EQ(percentile(std::vector<double>{7.0}, 0.01), 7.0);
  EXPECT_THROW(median({}), std::invalid_argument);
  EXPECT_THROW(percentile(hundred, 0.0), std::invalid_argument);
}

// 4000 experiments: the share of 95 % intervals that hold the truth has a standard error of 0.34 %.
TEST(Intervals, Coverage) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  int mean = 0, ratio = 0, paired = 0;
  constexpr int kExperiments = 4000;
  for (int e = 0; e < kExperiments; ++e) {
    std::vector<double> a(8), b(12), p(8);
    for (double& x : a) x = 10.0 + 2.0 * normal(random);
    for (double& x : b) x = 5.0 + 1.5 * normal(random);
    // Half of the spread of p is common with a.
    for (size_t i = 0; i < p.size(); ++i) p[i] = 5.0 + 0.5 * (a[i] - 10.0) + normal(random);
    const auto holds = [](const Interval& i, double truth) {
      return i.lo <= truth && truth <= i.hi;
    };
    mean += holds(meanInterval(a), 10.0);
    ratio += holds(ratioInterval(a, b), 2.0);
    paired += holds(pairedRatioInterval(a, p), 2.0);
  }
  EXPECT_NEAR(double(mean) / kExperiments, 0.95, 0.012);
  EXPECT_NEAR(double(ratio) / kExperiments, 0.95, 0.012);
  EXPECT_NEAR(double(paired) / kExperiments, 0.95, 0.012);
}

}  // namespace
}  // namespace restlab
