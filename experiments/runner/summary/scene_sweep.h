// Sweeps of a scene's parameter: up to which of its values every method holds.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/suite/scene_parameter.h"
#include "experiments/runner/summary/summary.h"

namespace restlab {

// A method at one value.
struct SweptCell {
  Interval energy{kUnknown, kUnknown, kUnknown};
  Interval error{kUnknown, kUnknown, kUnknown};  // root of the MSE over the mean of the reference
  uint64_t nonfinite = 0;
  bool holds = false;
};

struct SceneSweep {
  const Suite* suite = nullptr;
  std::string id, title;
  SweptParameter parameter;
  std::vector<std::string> methods;
  std::vector<std::vector<SweptCell>> cells;  // by method, then by value
  // The values that are there, by their places; a run that was interrupted lacks some.
  std::vector<bool> isThere;

  // The place of the last value, from the first on, up to which the method holds at all; nothing
  // where it does not hold at the first one.
  std::optional<size_t> lastThatHolds(size_t method) const;
};

// A value holds where nothing is without a finite value and the interval of the energy ratio
// touches 1 within the tolerance. An energy that is not known does not hold; without an interval
// (one run) its value counts.
bool holds(const Interval& energy, uint64_t nonfinite, double within);

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

// In markdown: a line a value, a column a method; last what still holds.
std::string sweepTable(const SceneSweep& sweep);
// As a block of the report (experiments/report/report_model.h): a row a method, a column a value,
// and the plot of errors.
nlohmann::ordered_json sweepDocument(const SceneSweep& sweep);

}  // namespace restlab
