// Axes of plots: range, position and ticks.
#pragma once

#include <string>
#include <vector>

namespace restlab {

// lo < hi; both positive where `log`.
struct Axis {
  bool log = false;
  double lo = 0.0, hi = 1.0;

  // 0 at lo, 1 at hi; outside of them where `value` is. NaN where the axis has no such value.
  double position(double value) const;
  bool shows(double value) const;
};

struct Tick {
  double value = 0.0;
  std::string label;     // "" for a minor tick
  std::string exponent;  // label "10" with a raised exponent, or ""
};

// The axis that holds every value of `inner` and, as far as that does not squeeze them, of `outer`
// (ends of intervals). Values that it cannot show are passed over. With nothing to show: 0.1..10
// or 0..1.
Axis fitAxis(bool log, const std::vector<double>& inner, const std::vector<double>& outer);

// In ascending order, all within the axis.
std::vector<Tick> axisTicks(const Axis& axis);

}  // namespace restlab
