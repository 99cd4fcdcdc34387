#include "experiments/statistics/welch.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/nan.h"

namespace restlab::stats {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check(const Sample& s) {
  if (s.n < 1.0) throw std::invalid_argument("welchTest: a sample without observations");
  if (s.variance < 0.0) throw std::invalid_argument("welchTest: a negative variance");
  if (s.variance > 0.0 && s.n <= 1.0) {
    throw std::invalid_argument("welchTest: one observation has no degree of freedom");
  }
}

// Returns v^2 / (n - 1) with v the variance of the mean; 0 for a constant, whose n - 1 may be 0.
double satterthwaiteTerm(double v, double n) { return v > 0.0 ? v * v / (n - 1.0) : 0.0; }

}  // namespace

Sample summarise(std::span<const double> observations) {
  if (observations.size() < 2) {
    throw std::invalid_argument("summarise: a variance needs two observations");
  }
  Sample s;
  s.n = double(observations.size());
  for (const double x : observations) s.mean += x;
  s.mean /= s.n;
  for (const double x : observations) s.variance += (x - s.mean) * (x - s.mean);
  s.variance /= s.n - 1.0;
  return s;
}

WelchResult welchTest(const Sample& a, const Sample& b) {
  check(a);
  check(b);
  WelchResult r;
  const double va = a.variance / a.n;
  const double vb = b.variance / b.n;
  r.difference = a.mean - b.mean;
  r.standardError = std::sqrt(va + vb);
  if (!std::isfinite(r.difference) || !std::isfinite(r.standardError)) {
    r.t = r.dof = r.pValue = kNan;
    return r;
  }
  if (va + vb == 0.0) {
    r.dof = kInfinity;
    r.t = r.difference == 0.0 ? 0.0 : std::copysign(kInfinity, r.difference);
    r.pValue = r.difference == 0.0 ? 1.0 : 0.0;
    return r;
  }
  r.t = r.difference / r.standardError;
  // Use the normal limit if the variance is so small that its square is 0.
  const double denominator = satterthwaiteTerm(va, a.n) + satterthwaiteTerm(vb, b.n);
  r.dof = denominator > 0.0 ? (va + vb) * (va + vb) / denominator : kInfinity;
  r.pValue = studentTwoSided(r.t, r.dof);
  return r;
}

double studentUpper(double t, double dof) {
  if (std::isnan(t) || std::isnan(dof)) return kNan;
  if (std::isinf(t)) return t > 0.0 ? 0.0 : 1.0;
  if (std::isinf(dof)) {
    return boost::math::cdf(boost::math::complement(boost::math::normal(), t));
  }
  return boost::math::cdf(boost::math::complement(boost::math::students_t(dof), t));
}

double studentTwoSided(double t, double dof) { return 2.0 * studentUpper(std::abs(t), dof); }

double studentQuantile(double p, double dof) {
  if (std::isinf(dof)) return boost::math::quantile(boost::math::normal(), p);
  return boost::math::quantile(boost::math::students_t(dof), p);
}

}  // namespace restlab::stats
