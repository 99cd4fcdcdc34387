// Numbers in JSON that may not be finite.
#pragma once

#include <nlohmann/json.hpp>

namespace restlab {

// Writes NaN and infinity, which JSON does not have, as "nan", "inf", "-inf".
nlohmann::ordered_json finiteJson(double value);
double finiteNumber(const nlohmann::ordered_json& value);

}  // namespace restlab
