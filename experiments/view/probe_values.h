// What a method keeps of a pixel, as the page and `render --pixel` say it.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/session.h"

namespace restlab {

// After the last frame: the radiance that is shown, then Session::probe(). Throws Error (badUsage)
// where there is no such pixel.
std::vector<ProbeValue> probedValues(const Session& session, uint32_t x, uint32_t y);

// [{"name", "value", "unit", "help"}, ...]; a value is a number, several numbers or a text.
nlohmann::ordered_json probedValuesJson(const Session& session, uint32_t x, uint32_t y);

}  // namespace restlab
