#include "experiments/runner/tables/markdown_cells.h"

#include <fmt/format.h>

#include <cmath>

namespace restlab {

namespace {

std::string timesWithEnds(const Interval& of) {
  return fmt::format("{}x{}", shortNumber(of.value), intervalText(of.lo, of.hi));
}

// Returns " at 12.5 ms"; "" for a column that is not read at a place.
std::string placeText(const Columns& columns, const Column& column, const MethodSummary& row) {
  if (column.noteKey.empty()) return "";
  const Column& place = columnAt(columns, column.noteKey);
  const std::string unit = place.unit.empty() ? "" : " " + place.unit;
  return fmt::format(" {} {}{}", column.noteWord, shortNumber(numberOf(place, row).value), unit);
}

std::string comparedCell(const Columns& columns, const Column& column, const MethodSummary& row,
                         const char* above, const char* below) {
  const Interval of = numberOf(column, row);
  if (isItself(column, row) || std::isnan(of.value)) return "";
  return timesText(of.value, of.lo, of.hi, above, below) + placeText(columns, column, row);
}

std::string withRatio(const Columns& columns, const Column& column, const char* ratioKey,
                      const MethodSummary& row) {
  const std::string ratio = lowerCell(columns, columnAt(columns, ratioKey), row);
  return fmt::format("{}{}", shortNumber(numberOf(column, row).value),
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

}  // namespace

std::string withEnds(const Interval& of, int digits) {
  return shortNumber(of.value, digits) + intervalText(of.lo, of.hi, digits);
}

std::string ratioWithEnds(const Interval& of) {
  return of.value > 0.0 ? withEnds(of) : "not known";
}

std::string textCell(const Columns&, const Column& column, const MethodSummary& row) {
  return textOf(column, row);
}

std::string numberCell(const Columns&, const Column& column, const MethodSummary& row) {
  return withEnds(numberOf(column, row), column.digits);
}

std::string knownCell(const Columns&, const Column& column, const MethodSummary& row) {
  const Interval of = numberOf(column, row);
  return std::isnan(of.value) ? "unknown" : withEnds(of, column.digits);
}

std::string numberOrNoneCell(const Columns&, const Column& column, const MethodSummary& row) {
  const Interval of = numberOf(column, row);
  return std::isnan(of.value) ? "" : withEnds(of, column.digits);
}

std::string valueOrNoneCell(const Columns&, const Column& column, const MethodSummary& row) {
  const double value = numberOf(column, row).value;
  return std::isnan(value) ? "" : shortNumber(value, column.digits);
}

std::string timeCell(const Columns&, const Column& column, const MethodSummary& row) {
  const double time = numberOf(column, row).value;
  return std::isnan(time) ? "unknown" : shortNumber(time) + " " + column.unit;
}

std::string timeAndRatioCell(const Columns& columns, const Column& column,
                             const MethodSummary& row) {
  const std::string time = timeCell(columns, column, row);
  const Column& ratio = columnAt(columns, "time_ratio");
  const Interval of = numberOf(ratio, row);
  if (isItself(ratio, row) || std::isnan(of.value)) return time;
  const bool isRatioAlone = std::isnan(numberOf(column, row).value);
  return isRatioAlone ? timesWithEnds(of) : fmt::format("{} ({})", time, timesWithEnds(of));
}

std::string timesCell(const Columns&, const Column& column, const MethodSummary& row) {
  const Interval of = numberOf(column, row);
  return std::isnan(of.value) ? "" : timesWithEnds(of);
}

std::string lowerCell(const Columns& columns, const Column& column, const MethodSummary& row) {
  return comparedCell(columns, column, row, "lower", "higher");
}

std::string fasterCell(const Columns& columns, const Column& column, const MethodSummary& row) {
  return comparedCell(columns, column, row, "faster", "slower");
}

std::string ratioCell(const Columns&, const Column& column, const MethodSummary& row) {
  const Interval of = numberOf(column, row);
  return isItself(column, row) || std::isnan(of.value) ? "" : ratioWithEnds(of);
}

std::string shareCell(const Columns&, const Column& column, const MethodSummary& row) {
  return fmt::format("{:.0f} {}", numberOf(column, row).value, column.unit);
}

std::string signedShareCell(const Columns&, const Column& column, const MethodSummary& row) {
  const Interval share = numberOf(column, row);
  if (std::isnan(share.value)) return "unknown";
  const std::string text = fmt::format("{:+.1f}", share.value);
  if (std::isnan(share.lo) || std::isnan(share.hi)) return text + " " + column.unit;
  if (std::isinf(share.lo) || std::isinf(share.hi)) return text + " [unbounded] " + column.unit;
  return fmt::format("{} [{:+.1f}, {:+.1f}] {}", text, share.lo, share.hi, column.unit);
}

std::string mseAndRatioCell(const Columns& columns, const Column& column,
                            const MethodSummary& row) {
  if (std::isnan(numberOf(column, row).value)) return "no such pixel";
  return withRatio(columns, column, "mse_ratio_without_lights", row);
}

std::string relmseAndRatioCell(const Columns& columns, const Column& column,
                               const MethodSummary& row) {
  return withRatio(columns, column, "relmse_e1e-2_trim0.1_ratio", row);
}

}  // namespace restlab
