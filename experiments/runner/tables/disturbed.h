// Detects whether other processes took time while frames were timed.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/tables/summary.h"

namespace restlab {

// Returns by which share the slowest twentieth of frames took longer than the same frame of other
// runs: 0.8 for 1.8 times their median. The same frame has the same view and age in all runs, so
// the difference is noise and the machine. With one run its other frames are used instead. Returns
// 0 without times, and for rows of images.
double disturbance(const MethodSummary& row);

// Rows above this disturbance were timed on a busy machine.
constexpr double kDisturbed = 0.25;

// Returns "- the machine was disturbed: ..." with the rows and the differences of their times; ""
// if no row was disturbed.
std::string disturbedNote(const std::vector<MethodSummary>& rows);

// Explains a time, the ratio in brackets and their p95: one line for all tables.
std::string timesExplained();

}  // namespace restlab
