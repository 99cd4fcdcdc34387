#include "experiments/report/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace restlab {
namespace {

// Limits by how much intervals may widen the range of the values: a factor, or a multiple of the
// span.
constexpr double kWidestFactor = 10.0, kWidestSpan = 0.5;

bool canShow(bool log, double value) { return std::isfinite(value) && (!log || value > 0.0); }

// Sets the label; without an exponent for decades in 0.001..10000.
void label(Tick& tick, bool decade) {
  const double size = std::abs(tick.value);
  if (decade && (size < 0.9e-3 || size > 1.1e4)) {
    tick.label = "10";
    tick.exponent = fmt::format("{:.0f}", std::log10(tick.value));
    if (tick.exponent[0] == '-') tick.exponent.replace(0, 1, "\xe2\x88\x92");
  } else {
    tick.label = fmt::format("{:.6g}", tick.value);
    if (tick.label[0] == '-') tick.label.replace(0, 1, "\xe2\x88\x92");
  }
}

std::vector<Tick> logTicks(const Axis& axis) {
  const int first = int(std::floor(std::log10(axis.lo) + 1e-9));
  const int last = int(std::floor(std::log10(axis.hi) + 1e-9));
  const double decades = std::log10(axis.hi / axis.lo);
  const int every = decades > 16.0 ? 4 : decades > 8.0 ? 2 : 1;
  std::vector<Tick> ticks;
  for (int decade = first; decade <= last; ++decade) {
    for (int digit = 1; digit <= 9; ++digit) {
      Tick tick;
      // Parsed from text: the value is the double nearest to 3e-5, say.
      tick.value = std::stod(fmt::format("{}e{}", digit, decade));
      if (!axis.shows(tick.value)) continue;
      const bool major = digit == 1 && decade % every == 0;
      const bool inBetween = (digit == 2 || digit == 5) && decades < 2.0;
      if (digit > 1 && decades > 10.0) continue;
      if (major || inBetween) label(tick, digit == 1);
      ticks.push_back(std::move(tick));
    }
  }
  return ticks;
}

// Returns 1, 2 or 5 times a power of ten, near `rough`.
double niceStep(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= rough * 0.999) return digit * power;
  }
  return 10.0 * power;
}

std::vector<Tick> linearTicks(const Axis& axis) {
  const double step = niceStep((axis.hi - axis.lo) / 6.0);
  std::vector<Tick> ticks;
  for (double i = std::ceil(axis.lo / step - 1e-9); i * step <= axis.hi + 1e-9 * step; i += 1.0) {
    Tick tick;
    tick.value = i * step + 0.0;  // avoids -0
    label(tick, false);
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

}  // namespace

double Axis::position(double value) const {
  if (!canShow(log, value)) return std::numeric_limits<double>::quiet_NaN();
  return log ? std::log(value / lo) / std::log(hi / lo) : (value - lo) / (hi - lo);
}

bool Axis::shows(double value) const {
  const double at = position(value);
  return at >= -1e-9 && at <= 1.0 + 1e-9;
}

Axis fitAxis(bool log, const std::vector<double>& inner, const std::vector<double>& outer) {
  Axis axis;
  axis.log = log;
  axis.lo = std::numeric_limits<double>::infinity();
  axis.hi = -axis.lo;
  for (const double value : inner) {
    if (!canShow(log, value)) continue;
    axis.lo = std::min(axis.lo, value);
    axis.hi = std::max(axis.hi, value);
  }
  if (!(axis.lo <= axis.hi)) {
    axis.lo = log ? 0.1 : 0.0;
    axis.hi = log ? 10.0 : 1.0;
    return axis;
  }
  const double span = axis.hi - axis.lo;
  const double least = log ? axis.lo / kWidestFactor : axis.lo - kWidestSpan * span;
  const double most = log ? axis.hi * kWidestFactor : axis.hi + kWidestSpan * span;
  for (const double value : outer) {
    if (!canShow(log, value)) continue;
    axis.lo = std::min(axis.lo, std::max(value, least));
    axis.hi = std::max(axis.hi, std::min(value, most));
  }
  // Leave room around the outermost marks; more if all values are equal up to rounding: ticks could
  // not tell them apart.
  const bool differ = axis.hi - axis.lo > 1e-9 * std::max(std::abs(axis.lo), std::abs(axis.hi));
  if (log) {
    const double room = differ ? std::pow(axis.hi / axis.lo, 0.05) : 2.0;
    axis.lo /= room;
    axis.hi *= room;
  } else {
    const double room =
        differ ? 0.05 * (axis.hi - axis.lo) : std::max(0.5 * std::abs(axis.hi), 1e-3);
    axis.lo = axis.lo >= 0.0 ? std::max(0.0, axis.lo - room) : axis.lo - room;
    axis.hi += room;
  }
  return axis;
}

std::vector<Tick> axisTicks(const Axis& axis) {
  // A shorter range has too few ticks at 1, 2 and 5 times powers of ten.
  constexpr double kHalfDecade = 3.5;
  return axis.log && axis.hi / axis.lo > kHalfDecade ? logTicks(axis) : linearTicks(axis);
}

}  // namespace restlab
