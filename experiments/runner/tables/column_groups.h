// Groups of columnsOf(), by what a row is known for.
#pragma once

#include "experiments/runner/tables/column.h"

namespace restlab {

// Scene, method and size, and whether the row counts.
Columns identityColumns();
// Errors, times, rays and bytes of single frames.
Columns frameColumns();
// Settings that the numbers depend on, device and reference.
Columns conditionColumns();
// Curves of accumulated frames.
Columns accumulatedColumns();
// Change from frame to frame.
Columns temporalColumns();
// Further metrics and masks of the suite.
Columns figureColumns(const Suite& suite);
// Health counters.
Columns healthColumns();

}  // namespace restlab
