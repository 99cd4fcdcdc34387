#include "experiments/statistics/tost.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace restlab::stats {

TostResult tostTest(const Sample& a, const Sample& b, double margin, double alpha) {
  if (!(margin > 0.0)) throw std::invalid_argument("tostTest: the margin must be positive");
  if (!(alpha > 0.0 && alpha < 0.5)) throw std::invalid_argument("tostTest: alpha not in (0, 0.5)");
  const WelchResult welch = welchTest(a, b);
  TostResult r;
  r.dof = welch.dof;
  if (std::isnan(welch.pValue)) {
    r.pLower = r.pUpper = r.pValue = r.lo = r.hi = welch.pValue;
    return r;
  }
  if (welch.standardError == 0.0) {
    r.pLower = welch.difference > -margin ? 0.0 : 1.0;
    r.pUpper = welch.difference < margin ? 0.0 : 1.0;
    r.lo = r.hi = welch.difference;
  } else {
    r.pLower = studentUpper((welch.difference + margin) / welch.standardError, welch.dof);
    r.pUpper = studentUpper((margin - welch.difference) / welch.standardError, welch.dof);
    const double half = studentQuantile(1.0 - alpha, welch.dof) * welch.standardError;
    r.lo = welch.difference - half;
    r.hi = welch.difference + half;
  }
  r.pValue = std::max(r.pLower, r.pUpper);
  return r;
}

}  // namespace restlab::stats
