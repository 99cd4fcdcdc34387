// Fields of summary.csv, which other tables of all numbers have as well.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/tables/columns.h"

namespace restlab {

// Value of a column, or an end of its interval.
struct CsvField {
  const Column* column;
  double Interval::*end;  // null: the value
  std::string name;

  // Returns a number (its interval is of no meaning), a count or a text.
  ColumnValue value(const MethodSummary& row) const;
};

// Returns the fields in the order of the file: first those that scripts depend on. The columns must
// outlive them.
std::vector<CsvField> csvFields(const Columns& columns);

}  // namespace restlab
