// Sweeps of a scene's parameter: up to which of its values every method holds.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/suite/scene_parameter.h"
#include "experiments/runner/summary/summary.h"

namespace restlab {

// Nothing is said of an energy whose interval is so wide that most errors would lie in it.
enum class Holding { yes, no, notDecided };

// A method at one value; as it is where the method has no row there.
struct SweptCell {
  Interval energy{kUnknown, kUnknown, kUnknown};
  Interval error{kUnknown, kUnknown, kUnknown};  // root of the MSE over the mean of the reference
  Interval biasShare{kUnknown, kUnknown, kUnknown};  // bias^2 / MSE
  double timeMs = kUnknown;                          // of a frame, median
  uint64_t nonfinite = 0;
  uint64_t faults = 0;  // all counts of health that are faults (isFault)
  Holding holding = Holding::notDecided;
};

struct SceneSweep {
  const Suite* suite = nullptr;
  std::string id, title;
  SweptParameter parameter;
  std::vector<std::string> methods;
  std::vector<std::vector<SweptCell>> cells;  // by method, then by value
  // The block of each value; a run that was interrupted lacks some.
  std::vector<std::optional<size_t>> blocks;

  // The place of the last value at which the method holds, of those before the first at which it
  // does not; nothing where there is none.
  std::optional<size_t> lastThatHolds(size_t method) const;
};

// A value holds where nothing is without a finite value and the interval of the energy ratio
// touches 1 within the tolerance and lies within kWidestTolerances tolerances of 1; it is not
// decided where it only touches, and without an interval (one run). An energy that is not known
// does not hold.
constexpr double kWidestTolerances = 5.0;
Holding holds(const Interval& energy, uint64_t nonfinite, double within);

// Is it off 1 by more than the tolerance and three half-widths of its interval? Of a correct method
// one in 10^5 is, with 16 runs. An energy without an interval never is.
bool isFarOff(const Interval& energy, double within);

struct SweptBlock {
  const Suite* suite;
  const std::vector<MethodSummary>* rows;
  double referenceMean;  // over pixels and channels
};

// The sweeps among the blocks: scenes of one [[scene]], by component and point.
std::vector<SceneSweep> sceneSweeps(const std::vector<SweptBlock>& blocks);

// In markdown: a row a method, with what it is like where it is worst.
std::string sweepTable(const SceneSweep& sweep);
// All of them, and what they have in common before the first; "" of none.
std::string sweepTables(const std::vector<SceneSweep>& sweeps);
// The same as a block of the report (experiments/report/report_model.h), with the energy of every
// value as details, and plots over the values.
nlohmann::ordered_json sweepDocument(const SceneSweep& sweep);

}  // namespace restlab
