// Confidence intervals over independent runs. Every function takes one number a run (its MSE, its
// frame time, ...), not one a frame or pixel: those are correlated and give intervals too narrow.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace restlab {

struct Interval {
  double value = 0.0;         // the estimate
  double lo = 0.0, hi = 0.0;  // NaN with fewer than two runs: the spread is unknown
};

// Variance of the noise that all runs share, and that their spread does not show, in the numbers of
// numerator and denominator.
struct SharedNoise {
  double numerator = 0.0, denominator = 0.0, covariance = 0.0;
};

// The interval with noise of this variance, which all runs share, added to it: half-widths are
// squared, added and rooted, its own being a normal deviation of the same confidence.
Interval widened(const Interval& interval, double sharedVariance, double confidence = 0.95);

// exp() of the estimate and of both ends: an interval of a logarithm as that of the number itself.
Interval exponential(const Interval& logarithm);

// Mean and its Student t interval. Throws std::invalid_argument without any run.
Interval meanInterval(std::span<const double> runs, double confidence = 0.95);

// mean(numerator) / mean(denominator) of independent sets of runs, which need not have the same
// size: Fieller's interval with Welch-Satterthwaite degrees of freedom. lo = -inf and hi = +inf
// when the denominator's own interval holds 0, for then no finite interval has the wanted coverage.
// `shared` widens it as widened() does.
Interval ratioInterval(std::span<const double> numerator, std::span<const double> denominator,
                       const SharedNoise& shared = {}, double confidence = 0.95);

// The same where numerator[i] and denominator[i] were measured together (interleaved frame times):
// their covariance narrows the interval. Where they are the same numbers, and not 0, the ratio is
// 1, and so are both ends. Throws std::invalid_argument on different sizes.
Interval pairedRatioInterval(std::span<const double> numerator, std::span<const double> denominator,
                             const SharedNoise& shared = {}, double confidence = 0.95);

// The interval of a ratio of numbers that cannot be negative, errors above all. A lower end that is
// not above 0 says that there is no bound: it is -inf. An upper end that is not above 0 is +inf.
Interval ratioOfPositives(const Interval& ratio);

// For positive numbers with a ratio scale, times above all: the geometric mean exp(mean(log)),
// whose interval is Student's t of the logarithms and so never reaches 0, and never holds a
// negative ratio however few the runs are. Where a number is not positive nothing but NaN is known.
Interval geometricMeanInterval(std::span<const double> runs, double confidence = 0.95);

// The ratio of the geometric means of independent sets of positive numbers: Welch's interval of the
// difference of the means of logarithms. The inverse ratio has the inverse interval.
Interval geometricRatioInterval(std::span<const double> numerator,
                                std::span<const double> denominator, double confidence = 0.95);

// The jackknife over runs (Tukey): `statistic` of the runs with these indices, for statistics that
// are no mean: a fitted slope, the logarithm of a ratio. The interval is Student's t of the
// pseudo-values; lo and hi are NaN with fewer than three runs. Throws std::invalid_argument without
// any run.
Interval jackknifeInterval(size_t runs,
                           const std::function<double(std::span<const size_t>)>& statistic,
                           double confidence = 0.95);

// The same for several statistics of the same runs, in the order in which `statistics` has them.
std::vector<Interval> jackknifeIntervals(
    size_t runs, const std::function<std::vector<double>(std::span<const size_t>)>& statistics,
    double confidence = 0.95);

// The middle value, or the mean of the two middle ones. Throws std::invalid_argument without
// values.
double median(std::span<const double> values);

// The smallest value that at least `fraction` of the values do not exceed (nearest rank).
double percentile(std::span<const double> values, double fraction);

}  // namespace restlab
