// Confidence intervals over independent runs. Every function takes one number per run (its MSE, its
// frame time, ...), not one per frame or pixel: those are correlated and give intervals too narrow.
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

// Variance and covariance, in numerator and denominator, of noise that all runs share and that the
// spread of runs does not show.
struct SharedNoise {
  double numerator = 0.0, denominator = 0.0, covariance = 0.0;
};

// Widens the interval by noise of this variance that all runs share: half-widths add in quadrature,
// and the noise's is a normal deviation of the same confidence.
Interval widened(const Interval& interval, double sharedVariance, double confidence = 0.95);

// exp() of the estimate and of both ends: turns the interval of a logarithm into that of the
// number.
Interval exponential(const Interval& logarithm);

// Mean and its Student t interval. Throws std::invalid_argument without any run.
Interval meanInterval(std::span<const double> runs, double confidence = 0.95);

// mean(numerator) / mean(denominator) of independent sets of runs, possibly of different size:
// Fieller's interval with Welch-Satterthwaite degrees of freedom. lo = -inf and hi = +inf if the
// denominator's own interval contains 0: no finite interval then has the wanted coverage. `shared`
// widens the interval as widened() does.
Interval ratioInterval(std::span<const double> numerator, std::span<const double> denominator,
                       const SharedNoise& shared = {}, double confidence = 0.95);

// Ratio of means if numerator[i] and denominator[i] were measured together (interleaved frame
// times): their covariance narrows the interval. If both hold the same numbers, and not 0, the
// ratio and both ends are 1. Throws std::invalid_argument on different sizes.
Interval pairedRatioInterval(std::span<const double> numerator, std::span<const double> denominator,
                             const SharedNoise& shared = {}, double confidence = 0.95);

// Interval of a ratio of numbers that cannot be negative, mainly errors. A lower end that is not
// above 0 means no bound and becomes -inf. An upper end that is not above 0 becomes +inf.
Interval ratioOfPositives(const Interval& ratio);

// Geometric mean exp(mean(log)) of positive numbers with a ratio scale, mainly times. The interval
// is Student's t of the logarithms and never reaches 0, however few the runs are. All results are
// NaN if a number is not positive.
Interval geometricMeanInterval(std::span<const double> runs, double confidence = 0.95);

// Ratio of the geometric means of independent sets of positive numbers: Welch's interval of the
// difference of the means of logarithms. The inverse ratio has the inverse interval.
Interval geometricRatioInterval(std::span<const double> numerator,
                                std::span<const double> denominator, double confidence = 0.95);

// Jackknife over runs (Tukey), for statistics that are not means: a fitted slope, the logarithm of
// a ratio. `statistic` is evaluated for the runs with the given indices. The interval is Student's
// t of the pseudo-values; lo and hi are NaN with fewer than three runs. Throws
// std::invalid_argument without any run.
Interval jackknifeInterval(size_t runs,
                           const std::function<double(std::span<const size_t>)>& statistic,
                           double confidence = 0.95);

// Jackknife of several statistics of the same runs, in the order of `statistics`.
std::vector<Interval> jackknifeIntervals(
    size_t runs, const std::function<std::vector<double>(std::span<const size_t>)>& statistics,
    double confidence = 0.95);

// The middle value, or the mean of the two middle ones. Throws std::invalid_argument without
// values.
double median(std::span<const double> values);

// Smallest value that at least `fraction` of the values do not exceed (nearest rank).
double percentile(std::span<const double> values, double fraction);

}  // namespace restlab
