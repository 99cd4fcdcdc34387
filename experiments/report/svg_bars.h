// Stacked horizontal bars as SVG: the time of each pass in a method's frame.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/report/report_model.h"

namespace restlab {

struct BarsSpec {
  struct Row {
    std::string name;
    std::vector<std::pair<std::string, double>> parts;  // at least 0
  };
  std::string title, unit;
  std::vector<Row> rows;
};

// Returns a complete SVG document, identical bytes for identical bars. Equal part names have one
// colour in all rows; the sum stands behind each bar.
std::string barsSvg(const BarsSpec& bars);

// Reads the member "bars" of a block of a checked model.
BarsSpec barsFromModel(const ReportModel& bars);

}  // namespace restlab
