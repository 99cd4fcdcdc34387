#include "experiments/statistics/intervals.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/base/nan.h"

namespace restlab {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Moments {
  double n = 0.0, mean = 0.0;
  double varianceOfMean = kNan;  // NaN with one run
};

Moments momentsOf(std::span<const double> runs) {
  if (runs.empty()) throw std::invalid_argument("an interval needs at least one run");
  Moments m;
  m.n = double(runs.size());
  for (const double x : runs) m.mean += x;
  m.mean /= m.n;
  if (runs.size() > 1) {
    double sum = 0.0;
    for (const double x : runs) sum += (x - m.mean) * (x - m.mean);
    m.varianceOfMean = sum / (m.n - 1.0) / m.n;
  }
  return m;
}

// Two-sided quantile of Student's t distribution.
double tQuantile(double dof, double confidence) {
  const boost::math::students_t_distribution<double> t(dof);
  return boost::math::quantile(boost::math::complement(t, 0.5 * (1.0 - confidence)));
}

double normalQuantile(double confidence) {
  const boost::math::normal_distribution<double> normal;
  return boost::math::quantile(boost::math::complement(normal, 0.5 * (1.0 - confidence)));
}

// Welch-Satterthwaite degrees of freedom of a difference of means with these variances.
double welchDof(double va, double na, double vb, double nb) {
  return (va + vb) * (va + vb) / (va * va / (na - 1.0) + vb * vb / (nb - 1.0));
}

std::vector<double> logarithms(std::span<const double> positive) {
  std::vector<double> logs;
  for (const double x : positive) logs.push_back(x > 0.0 ? std::log(x) : kNan);
  return logs;
}

// Fieller's interval: all ratios q for which a - q b is within t standard errors of 0, that is
// (b^2 - t^2 vb) q^2 - 2 (a b - t^2 vab) q + (a^2 - t^2 va) <= 0, with the (co)variances of means.
Interval fieller(double a, double b, double va, double vb, double vab, double t,
                 const SharedNoise& shared, double confidence) {
  // Scale the shared noise to z normal standard deviations, as the formula multiplies by t.
  const double z = normalQuantile(confidence);
  va += z * z / (t * t) * shared.numerator;
  vb += z * z / (t * t) * shared.denominator;
  vab += z * z / (t * t) * shared.covariance;
  const double ratio = a / b;
  const double quadratic = b * b - t * t * vb;
  if (!(quadratic > 0.0)) return {ratio, -kInfinity, kInfinity};
  const double linear = a * b - t * t * vab;
  const double constant = a * a - t * t * va;
  const double root = std::sqrt(std::max(0.0, linear * linear - quadratic * constant));
  return {ratio, (linear - root) / quadratic, (linear + root) / quadratic};
}

}  // namespace

Interval exponential(const Interval& logarithm) {
  return {std::exp(logarithm.value), std::exp(logarithm.lo), std::exp(logarithm.hi)};
}

Interval widened(const Interval& interval, double sharedVariance, double confidence) {
  const double own = normalQuantile(confidence) * std::sqrt(sharedVariance);
  return {interval.value, interval.value - std::hypot(interval.value - interval.lo, own),
          interval.value + std::hypot(interval.hi - interval.value, own)};
}

Interval meanInterval(std::span<const double> runs, double confidence) {
  const Moments m = momentsOf(runs);
  if (runs.size() < 2 || std::isnan(m.mean)) return {m.mean, kNan, kNan};
  const double half = tQuantile(m.n - 1.0, confidence) * std::sqrt(m.varianceOfMean);
  return {m.mean, m.mean - half, m.mean + half};
}

Interval ratioInterval(std::span<const double> numerator, std::span<const double> denominator,
                       const SharedNoise& shared, double confidence) {
  const Moments a = momentsOf(numerator);
  const Moments b = momentsOf(denominator);
  const double ratio = a.mean / b.mean;
  if (numerator.size() < 2 || denominator.size() < 2 || std::isnan(ratio)) {
    return {ratio, kNan, kNan};
  }
  // Welch-Satterthwaite degrees of freedom for a - ratio b.
  const double va = a.varianceOfMean;
  const double vb = ratio * ratio * b.varianceOfMean;
  const double dof = va + vb == 0.0 ? std::min(a.n, b.n) - 1.0 : welchDof(va, a.n, vb, b.n);
  return fieller(a.mean, b.mean, va, b.varianceOfMean, 0.0, tQuantile(dof, confidence), shared,
                 confidence);
}

Interval pairedRatioInterval(std::span<const double> numerator, std::span<const double> denominator,
                             const SharedNoise& shared, double confidence) {
  if (numerator.size() != denominator.size()) {
    throw std::invalid_argument("paired runs need as many numerators as denominators");
  }
  const Moments a = momentsOf(numerator);
  const Moments b = momentsOf(denominator);
  const double ratio = a.mean / b.mean;
  if (std::equal(numerator.begin(), numerator.end(), denominator.begin()) && ratio == 1.0)
    return {1.0, 1.0, 1.0};
  if (numerator.size() < 2 || std::isnan(ratio)) return {ratio, kNan, kNan};
  double covariance = 0.0;
  for (size_t i = 0; i < numerator.size(); ++i) {
    covariance += (numerator[i] - a.mean) * (denominator[i] - b.mean);
  }
  covariance /= (a.n - 1.0) * a.n;
  return fieller(a.mean, b.mean, a.varianceOfMean, b.varianceOfMean, covariance,
                 tQuantile(a.n - 1.0, confidence), shared, confidence);
}

Interval ratioOfPositives(const Interval& ratio) {
  return {ratio.value, ratio.lo <= 0.0 ? -kInfinity : ratio.lo,
          ratio.hi <= 0.0 ? kInfinity : ratio.hi};
}

Interval geometricMeanInterval(std::span<const double> runs, double confidence) {
  return exponential(meanInterval(logarithms(runs), confidence));
}

Interval geometricRatioInterval(std::span<const double> numerator,
                                std::span<const double> denominator, double confidence) {
  const Moments a = momentsOf(logarithms(numerator));
  const Moments b = momentsOf(logarithms(denominator));
  const double ratio = a.mean - b.mean;
  if (numerator.size() < 2 || denominator.size() < 2 || std::isnan(ratio))
    return exponential({ratio, kNan, kNan});
  const double va = a.varianceOfMean, vb = b.varianceOfMean;
  if (va + vb == 0.0) return exponential({ratio, ratio, ratio});
  const double half = tQuantile(welchDof(va, a.n, vb, b.n), confidence) * std::sqrt(va + vb);
  return exponential({ratio, ratio - half, ratio + half});
}

Interval jackknifeInterval(size_t runs,
                           const std::function<double(std::span<const size_t>)>& statistic,
                           double confidence) {
  const auto one = [&](std::span<const size_t> chosen) {
    return std::vector<double>{statistic(chosen)};
  };
  return jackknifeIntervals(runs, one, confidence).front();
}

std::vector<Interval> jackknifeIntervals(
    size_t runs, const std::function<std::vector<double>(std::span<const size_t>)>& statistics,
    double confidence) {
  if (runs == 0) throw std::invalid_argument("an interval needs at least one run");
  std::vector<size_t> all(runs);
  std::iota(all.begin(), all.end(), size_t{0});
  std::vector<Interval> intervals;
  for (const double value : statistics(all)) intervals.push_back({value, kNan, kNan});
  if (runs < 3) return intervals;
  const double n = double(runs);
  std::vector<std::vector<double>> pseudo(intervals.size());
  for (size_t left = 0; left < runs; ++left) {
    std::vector<size_t> others;
    for (const size_t i : all) {
      if (i != left) others.push_back(i);
    }
    const std::vector<double> without = statistics(others);
    for (size_t s = 0; s < intervals.size(); ++s)
      pseudo[s].push_back(n * intervals[s].value - (n - 1.0) * without.at(s));
  }
  for (size_t s = 0; s < intervals.size(); ++s) {
    const Interval around = meanInterval(pseudo[s], confidence);
    intervals[s].lo = intervals[s].value + (around.lo - around.value);
    intervals[s].hi = intervals[s].value + (around.hi - around.value);
  }
  return intervals;
}

double median(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("a median needs at least one value");
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

double percentile(std::span<const double> values, double fraction) {
  if (values.empty()) throw std::invalid_argument("a percentile needs at least one value");
  if (!(fraction > 0.0 && fraction <= 1.0)) {
    throw std::invalid_argument("a percentile's fraction must be in (0, 1]");
  }
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double rank = std::ceil(fraction * double(sorted.size()));
  return sorted[std::min(sorted.size(), size_t(rank)) - 1];
}

}  // namespace restlab
