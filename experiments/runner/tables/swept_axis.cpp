#include "experiments/runner/tables/swept_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace restlab {

nlohmann::ordered_json SweptAxis::document(const std::string& title) const {
  nlohmann::ordered_json axis = {{"title", title}, {"log", isLog}};
  if (!note.empty()) axis["note"] = note;
  return axis;
}

SweptAxis sweptAxis(const std::vector<double>& values, double farApart) {
  constexpr double kFarFromZero = 1000.0;
  const double least = *std::min_element(values.begin(), values.end());
  const double most = *std::max_element(values.begin(), values.end());
  double leastAbove = std::numeric_limits<double>::infinity();
  for (const double value : values)
    if (value > 0.0) leastAbove = std::min(leastAbove, value);
  if (least > 0.0) return {most > farApart * least, 0.0, ""};
  if (least < 0.0 || most < kFarFromZero * leastAbove) return {};
  const double zeroAt = leastAbove / 10.0;
  return {true, zeroAt, fmt::format("0 is drawn at {:g}", zeroAt)};
}

}  // namespace restlab
