// Sweeps of a scene's parameter: up to which value does each method hold?
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/suite/scene_parameter.h"
#include "experiments/runner/tables/summary.h"

namespace restlab {

// An energy whose interval is so wide that most errors would lie in it is not decided.
enum class Holding { yes, no, notDecided };

// A method at one value; default values if the method has no row there.
struct SweptCell {
  Interval energy{kUnknown, kUnknown, kUnknown};
  Interval error{kUnknown, kUnknown, kUnknown};  // root of the MSE over the mean of the reference
  Interval biasShare{kUnknown, kUnknown, kUnknown};  // bias^2 / MSE
  double timeMs = kUnknown;                          // median of a frame
  uint64_t nonfinite = 0;
  uint64_t faults = 0;  // sum of all health counts that are faults (isFault)
  Holding holding = Holding::notDecided;
};

struct SceneSweep {
  const Suite* suite = nullptr;
  std::string id, title;
  SweptParameter parameter;
  std::vector<std::string> methods;
  std::vector<std::vector<SweptCell>> cells;  // by method, then by value
  // Block of each value; absent if an interrupted run lacks it.
  std::vector<std::optional<size_t>> blocks;

  // Returns the index of the last value at which the method holds, before the first at which it
  // does not; nothing if there is none.
  std::optional<size_t> lastThatHolds(size_t method) const;
};

// A value holds if all values of the images are finite and the interval of the energy ratio touches
// 1 within the tolerance and lies within kWidestTolerances tolerances of 1. If the interval only
// touches, or is unknown (one run), the value is not decided. A value with unknown energy does not
// hold.
constexpr double kWidestTolerances = 5.0;
Holding holds(const Interval& energy, uint64_t nonfinite, double within);

// Returns whether the energy is off 1 by more than the tolerance and three half-widths of its
// interval. With 16 runs this holds for one in 10^5 correct methods. False without an interval.
bool isFarOff(const Interval& energy, double within);

struct SweptBlock {
  const Suite* suite;
  const std::vector<MethodSummary>* rows;
  double referenceMean;  // over pixels and channels
};

// Finds the sweeps among the blocks: scenes of one [[scene]], by component and point.
std::vector<SceneSweep> sceneSweeps(const std::vector<SweptBlock>& blocks);

// Returns a markdown table: one row per method, with its figures at their worst value.
std::string sweepTable(const SceneSweep& sweep);
// Returns all tables, with a common explanation before the first; "" without sweeps.
std::string sweepTables(const std::vector<SceneSweep>& sweeps);
// Returns a sweep as a block of the report (experiments/report/report_model.h), with the energy of
// every value as details, and plots over the values.
nlohmann::ordered_json sweepDocument(const SceneSweep& sweep);

}  // namespace restlab
