// Welch's t-test from summaries, so that runs need not be kept.
#pragma once

#include <span>

namespace restlab::stats {

// Summary of n independent observations. A constant known without error is {1, value, 0}. An
// estimate known only by its standard error is {n, value, n * error^2}, with n - 1 its degrees of
// freedom.
struct Sample {
  double n = 0.0;
  double mean = 0.0;
  double variance = 0.0;  // of one observation, unbiased (divided by n - 1)
};

// Throws std::invalid_argument for fewer than two observations.
Sample summarise(std::span<const double> observations);

struct WelchResult {
  double difference = 0.0;     // mean a - mean b
  double standardError = 0.0;  // of the difference
  double t = 0.0;              // infinite if constants differ
  double dof = 0.0;            // Welch-Satterthwaite; infinite if both variances are 0
  double pValue = 0.0;         // two-sided; NaN if any input is NaN
};

// Throws std::invalid_argument for n < 1, a negative variance, or a variance other than 0 with n
// = 1.
WelchResult welchTest(const Sample& a, const Sample& b);

// Returns P(|T| >= |t|) of Student's t; of the normal distribution for infinite dof.
double studentTwoSided(double t, double dof);

// Returns P(T >= t).
double studentUpper(double t, double dof);

// Returns the t with P(T <= t) = p.
double studentQuantile(double p, double dof);

}  // namespace restlab::stats
