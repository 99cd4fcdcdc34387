// Whether something else than the program took time while frames were timed.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// The share by which one frame in twenty took longer than the same frame of other runs: 0.8 where
// it took 1.8 times their median. The same frame has the same view and age in all runs, so that
// nothing but noise and the machine is in it. Of one run the other frames stand for other runs. 0
// without times, and of rows of images.
double disturbance(const MethodSummary& row);

// A row whose disturbance is above this has times of a machine that did something else as well.
constexpr double kDisturbed = 0.25;

// "- the machine was disturbed: ..." with the rows and what their times differ by; "" where it was
// not.
std::string disturbedNote(const std::vector<MethodSummary>& rows);

// How a time, its ratio in brackets and their p95 belong together: one line for all tables.
std::string timesExplained();

}  // namespace restlab
