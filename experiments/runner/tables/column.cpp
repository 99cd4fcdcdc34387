#include "experiments/runner/tables/column.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace restlab {

const Column& columnAt(const Columns& columns, const std::string& key) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const Column& column) { return column.key == key; });
  if (found == columns.end()) throw std::out_of_range("no column '" + key + "'");
  return *found;
}

std::vector<const Column*> withFirst(const Columns& columns, const std::vector<std::string>& keys) {
  std::vector<const Column*> all;
  for (const std::string& key : keys) all.push_back(&columnAt(columns, key));
  for (const Column& column : columns)
    if (std::find(all.begin(), all.end(), &column) == all.end()) all.push_back(&column);
  return all;
}

Interval numberOf(const Column& column, const MethodSummary& row) {
  const ColumnValue value = column.get(row);
  if (const uint64_t* count = std::get_if<uint64_t>(&value)) return only(double(*count));
  const Interval* number = std::get_if<Interval>(&value);
  if (number == nullptr) return kNone;
  switch (column.form) {
    case Form::error:
      return errorOf(*number);
    case Form::percent:
      return percent(*number);
    case Form::plain:
      break;
  }
  return *number;
}

std::string exactNumber(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return fmt::format("{:.9g}", value);
}

std::string textOf(const Column& column, const MethodSummary& row) {
  const ColumnValue value = column.get(row);
  if (const uint64_t* count = std::get_if<uint64_t>(&value)) return std::to_string(*count);
  if (const Interval* number = std::get_if<Interval>(&value)) return exactNumber(number->value);
  return std::get<std::string>(value);
}

bool isKnown(const Column& column, const std::vector<MethodSummary>& rows) {
  return std::any_of(rows.begin(), rows.end(), [&](const MethodSummary& row) {
    return !std::isnan(numberOf(column, row).value);
  });
}

bool isItself(const Column& column, const MethodSummary& row) {
  return (column.against == Against::baseline && row.isBaseline) ||
         (column.against == Against::average && row.isAverage);
}

bool isRanked(const Column& column, const MethodSummary& row) {
  if (column.ranked == Ranked::measured) return !row.method->images;
  return column.ranked == Ranked::all || numberOf(column, row).value > 0.0;
}

}  // namespace restlab
