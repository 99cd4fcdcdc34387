// Axis of a plot over the values of a sweep.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace restlab {

struct SweptAxis {
  bool isLog = false;
  double zeroAt = 0.0;  // where 0 is drawn on a logarithmic axis: left of all other values
  std::string note;     // says so

  double at(double value) const { return value == 0.0 ? zeroAt : value; }
  // Returns a member "x" of a plot (experiments/report/report_model.h).
  nlohmann::ordered_json document(const std::string& title) const;
};

// Chooses the axis for at least one value. It is logarithmic where the largest is more than
// `farApart` times the least above 0, or 1000 times where one is 0; never with a value below 0.
SweptAxis sweptAxis(const std::vector<double>& values, double farApart);

}  // namespace restlab
