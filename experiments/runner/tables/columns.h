// The columns of tables. Adding one takes an entry here, and its key in the writers of narrow
// tables that are to show it (table.cpp, table_tex.cpp); summary.csv and the report show all.
#pragma once

#include <vector>

#include "experiments/runner/tables/column.h"

namespace restlab {

// Returns the columns of a block in the order of summary.csv, with names in their titles. `rows`:
// at least one.
Columns columnsOf(const std::vector<MethodSummary>& rows);

}  // namespace restlab
