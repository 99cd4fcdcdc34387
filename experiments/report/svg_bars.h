// Stacked horizontal bars as SVG: what each pass of a method takes of its frame.
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

// A whole SVG document, the same bytes for the same bars. A part's name has one colour in all rows;
// the sum stands behind each bar.
std::string barsSvg(const BarsSpec& bars);

// The member "bars" of a block of a checked model.
BarsSpec barsFromModel(const ReportModel& bars);

}  // namespace restlab
