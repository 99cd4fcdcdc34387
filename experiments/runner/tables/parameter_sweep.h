// Sweeps over numbers of settings and of keys of methods: the MSE over the value.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/runner/tables/scene_sweep.h"
#include "experiments/runner/tables/summary.h"

namespace restlab {

// Returns a plot for every key that methods of the block sweep over numbers: a line for each method
// and each combination of its other swept values. [] without such keys. Members of "plots" of the
// report (experiments/report/report_model.h).
nlohmann::ordered_json methodSweepPlots(const std::vector<MethodSummary>& rows);

// A scene at all points of a sweep over settings.
struct SettingSweep {
  nlohmann::ordered_json document;  // block of the report
  std::vector<size_t> blocks;       // at its points
};

// Finds scenes, by component, that stand at several values of a swept number, and plots the MSE of
// each method over each such setting: a line for each method and each combination of other values.
std::vector<SettingSweep> settingSweeps(const std::vector<SweptBlock>& blocks);

}  // namespace restlab
