// Column of tables of methods: where its values come from, and how each writer names it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "experiments/report/text.h"
#include "experiments/runner/tables/summary.h"

namespace restlab {

// Number with its interval (NaN: unknown), count or text.
using ColumnValue = std::variant<Interval, uint64_t, std::string>;

// Writers that show the interval: those for people leave summary.csv out.
enum class Ends { none, people, all };
// Form of a number for people. Errors are unbounded below where their interval reaches 0
// (errorOf()); shares are percentages.
enum class Form { plain, error, percent };
// Numbers that may be compared with those of other rows. Errors below the reference's noise are not
// `positive`, times of other programs are not `measured` here.
enum class Ranked { all, positive, measured };
// Row that a ratio is relative to. It is 1 there, and narrow tables leave it out.
enum class Against { nothing, baseline, average };

struct Column {
  std::string key;  // name in summary.csv
  std::function<ColumnValue(const MethodSummary&)> get;
  Ends ends = Ends::none;
  bool inCsv = true;
  // Titles of the report, of table.md and of table.tex (with its markup). {0} is the baseline's
  // name, {1} the average's, {2} the first backend. Without a title the report leaves the column
  // out; without one of the others a table has that of the report.
  std::string title = {}, narrow = {}, tex = {};
  std::string reportKey = {};  // "": the key
  std::string unit = {};
  std::string better = "none";  // "lower", "higher" or "none"
  std::string help = {};
  bool isMain = false;  // in the report's first table
  int digits = kDigits;
  Form form = Form::plain;
  Ranked ranked = Ranked::all;
  Against against = Against::nothing;
  // Place at which the value was read: a word, and the key of a column: "at", "equal_time_ms".
  std::string noteWord = {}, noteKey = {};
};

using Columns = std::vector<Column>;

inline constexpr Interval kNone{kUnknown, kUnknown, kUnknown};
// Returns a number without an interval.
inline Interval only(double value) { return {value, kUnknown, kUnknown}; }

// Throws std::out_of_range if there is no column of that key.
const Column& columnAt(const Columns& columns, const std::string& key);
// Returns the columns of these keys in their order, then all others.
std::vector<const Column*> withFirst(const Columns& columns, const std::vector<std::string>& keys);

// Returns a number or count in its form for people; kNone for a text.
Interval numberOf(const Column& column, const MethodSummary& row);
// Returns a text as it is, and a number or count with all its digits.
std::string textOf(const Column& column, const MethodSummary& row);
// Returns a number with all its digits: "0.0277777778", "nan", "inf".
std::string exactNumber(double value);

// Returns whether the number is known in some row.
bool isKnown(const Column& column, const std::vector<MethodSummary>& rows);
// Returns whether the row is the one that the ratio is relative to.
bool isItself(const Column& column, const MethodSummary& row);
// Returns whether the row's number may be compared with those of other rows.
bool isRanked(const Column& column, const MethodSummary& row);

}  // namespace restlab
