// What a method keeps of a pixel and did there, as the page and `render --pixel` say it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/session.h"

namespace restlab {

// After the last frame: the radiance that is shown, then Session::probe(). Throws Error (badUsage)
// where there is no such pixel.
std::vector<ProbeValue> probedValues(const Session& session, uint32_t x, uint32_t y);

// [{"name", "value", "unit", "help"}, ...]; a value is a number, several numbers or a text.
nlohmann::ordered_json probedValuesJson(const Session& session, uint32_t x, uint32_t y);

// Session::donors(): a line each, and [{"reuse", "x", "y" or "entry", "shift", "confidence",
// "mis_weight", "share", "jacobian", "selected"}, ...] with null for what is not known.
std::string probedDonorsText(const Session& session, uint32_t x, uint32_t y);
nlohmann::ordered_json probedDonorsJson(const Session& session, uint32_t x, uint32_t y);

}  // namespace restlab
