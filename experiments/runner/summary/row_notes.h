// The lines below a table: what is said of several rows is said once.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// One line a kind of flag: "- path; gi: text". Flags that differ in their numbers alone are one
// line from three rows on: the text of the first row, and the names of the others.
std::string rowNotes(const std::vector<MethodSummary>& rows);

}  // namespace restlab
