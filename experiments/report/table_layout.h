// Layout of a block's tables: columns that are said once below them, and columns that stand side by
// side in a window of 1280 CSS pixels.
#pragma once

#include <string>
#include <vector>

#include "experiments/report/report_model.h"

namespace restlab {

// Lines of a cell, one below the other; "" for one that is not there.
struct CellLines {
  std::string value, interval, note;
};
CellLines cellLines(const ReportModel& cell, int digits);

// Returns the cell of a row in the column `key`, or null.
const ReportModel* cellOf(const ReportModel& row, const std::string& key);

using ReportColumns = std::vector<const ReportModel*>;

// The columns of a checked block; they point into it.
struct TableLayout {
  ReportColumns once;                  // equal in all of at least two rows
  ReportColumns first;                 // table of results
  std::vector<ReportColumns> details;  // further tables
};

// Columns with "detail" stand in further tables, and so do those that do not fit into the first.
// That one keeps its columns if all of them are equal in all rows.
TableLayout layOutTable(const ReportModel& block);

// Width in CSS pixels that a column cannot do without: its heading wraps, its cells do not.
double columnWidth(const std::string& heading, const std::vector<CellLines>& cells);

// Distributes columns of these widths, in their order, to as few tables as fit; returns the number
// of columns of each. A column that is wider than a table has one of its own.
std::vector<size_t> splitToFit(const std::vector<double>& widths);

}  // namespace restlab
