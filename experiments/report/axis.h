// Axes of plots: range, position and ticks.
#pragma once

#include <string>
#include <vector>

namespace restlab {

// Requires lo < hi; both positive if `log`.
struct Axis {
  bool log = false;
  double lo = 0.0, hi = 1.0;

  // Position of a value: 0 at lo, 1 at hi, also outside of them. NaN if the axis cannot show the
  // value.
  double position(double value) const;
  bool shows(double value) const;
};

struct Tick {
  double value = 0.0;
  std::string label;     // "" for a minor tick
  std::string exponent;  // exponent of the label "10", or ""
};

// Fits an axis to all values of `inner` and, as far as they do not squeeze those, of `outer` (ends
// of intervals). Values that the axis cannot show are ignored. Without values: 0.1..10 or 0..1.
Axis fitAxis(bool log, const std::vector<double>& inner, const std::vector<double>& outer);

// Returns the ticks within the axis in ascending order.
std::vector<Tick> axisTicks(const Axis& axis);

}  // namespace restlab
