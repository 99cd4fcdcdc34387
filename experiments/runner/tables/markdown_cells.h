// Cells of table.md: forms in which a column's number stands there.
#pragma once

#include <string>

#include "experiments/runner/tables/column.h"

namespace restlab {

// Returns the text of a cell. `columns`: for cells that show a second column.
using MarkdownCell = std::string (*)(const Columns& columns, const Column& column,
                                     const MethodSummary& row);

// Returns a number followed by its interval: "0.0278 [0.0270, 0.0286]".
std::string withEnds(const Interval& of, int digits = kDigits);
// Returns the same for a ratio; "not known" unless it is positive.
std::string ratioWithEnds(const Interval& of);

std::string textCell(const Columns& columns, const Column& column, const MethodSummary& row);
// Number with its interval.
std::string numberCell(const Columns& columns, const Column& column, const MethodSummary& row);
// The same; "unknown", or "", where it is unknown.
std::string knownCell(const Columns& columns, const Column& column, const MethodSummary& row);
std::string numberOrNoneCell(const Columns& columns, const Column& column,
                             const MethodSummary& row);
// Number without its interval; "" where it is unknown.
std::string valueOrNoneCell(const Columns& columns, const Column& column, const MethodSummary& row);
// "12.5 ms"; "unknown".
std::string timeCell(const Columns& columns, const Column& column, const MethodSummary& row);
// "12.5 ms (1.40x [1.38, 1.42])": with the ratio of times to the baseline.
std::string timeAndRatioCell(const Columns& columns, const Column& column,
                             const MethodSummary& row);
// "1.40x [1.38, 1.42]"; "".
std::string timesCell(const Columns& columns, const Column& column, const MethodSummary& row);
// "2.5x lower [2.3, 2.8]", with the place at which it was read; "" in the row that the ratio is
// relative to, and where it is unknown. Likewise "2.5x faster".
std::string lowerCell(const Columns& columns, const Column& column, const MethodSummary& row);
std::string fasterCell(const Columns& columns, const Column& column, const MethodSummary& row);
// Ratio with its interval; "" like lowerCell().
std::string ratioCell(const Columns& columns, const Column& column, const MethodSummary& row);
// "12 %".
std::string shareCell(const Columns& columns, const Column& column, const MethodSummary& row);
// "+1.2 [-0.3, +2.7] %"; "unknown".
std::string signedShareCell(const Columns& columns, const Column& column, const MethodSummary& row);
// Error with its ratio to that of the baseline: "0.0278 (2.5x lower [2.3, 2.8])".
std::string mseAndRatioCell(const Columns& columns, const Column& column, const MethodSummary& row);
std::string relmseAndRatioCell(const Columns& columns, const Column& column,
                               const MethodSummary& row);

}  // namespace restlab
