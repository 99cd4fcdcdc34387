#include "experiments/runner/base/json_number.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace restlab {

using Json = nlohmann::ordered_json;

Json finiteJson(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

double finiteNumber(const Json& value) {
  if (value.is_number()) return value.get<double>();
  const std::string text = value.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  throw std::invalid_argument("'" + text + "' is no number");
}

}  // namespace restlab
