#include "experiments/statistics/power.h"

#include <boost/math/distributions/non_central_t.hpp>
#include <cmath>
#include <stdexcept>

#include "experiments/statistics/welch.h"

namespace restlab::stats {
namespace {

void check(double alpha, double power) {
  if (!(alpha > 0.0 && alpha < 1.0 && power > alpha && power < 1.0)) {
    throw std::invalid_argument("power: 0 < alpha < power < 1 is wanted");
  }
}

}  // namespace

double testPower(double shift, double standardError, double dof, double alpha) {
  check(alpha, 0.5 * (1.0 + alpha));
  if (!(standardError > 0.0 && dof > 0.0)) {
    throw std::invalid_argument("power: standard error and dof must be positive");
  }
  const double noncentrality = std::abs(shift) / standardError;
  // Avoid 1 - alpha/2, which would round for a tiny alpha.
  const double critical = -studentQuantile(0.5 * alpha, dof);
  if (std::isinf(dof) || noncentrality == 0.0) {
    return studentUpper(critical - noncentrality, dof) +
           studentUpper(critical + noncentrality, dof);
  }
  const boost::math::non_central_t_distribution<double> t(dof, noncentrality);
  return boost::math::cdf(boost::math::complement(t, critical)) + boost::math::cdf(t, -critical);
}

double smallestDetectableShift(double standardError, double dof, double alpha, double power) {
  check(alpha, power);
  if (!(standardError > 0.0 && dof > 0.0)) {
    throw std::invalid_argument("power: standard error and dof must be positive");
  }
  // Power grows with the shift: bracket, then bisect.
  double lo = 0.0, hi = 1.0;
  while (testPower(hi, 1.0, dof, alpha) < power) {
    lo = hi;
    hi *= 2.0;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lo + hi);
    (testPower(middle, 1.0, dof, alpha) < power ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi) * standardError;
}

}  // namespace restlab::stats
