// Notes below a table; a note on several rows is written once.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/tables/summary.h"

namespace restlab {

// Returns one line per kind of flag: "- path; gi: text". From three rows on, flags that differ only
// in numbers are merged: the text of the first row, and the names of the others.
std::string rowNotes(const std::vector<MethodSummary>& rows);

}  // namespace restlab
