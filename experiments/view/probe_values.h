// Values that a method keeps for a pixel, as the page and `render --pixel` show them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/frame/session.h"

namespace restlab {

// Returns the shown radiance of the last frame, then Session::probe(). Throws Error (badUsage) if
// there is no such pixel.
std::vector<ProbeValue> probedValues(const Session& session, uint32_t x, uint32_t y);

// [{"name", "value", "unit", "help"}, ...]; a value is a number, several numbers or a text.
nlohmann::ordered_json probedValuesJson(const Session& session, uint32_t x, uint32_t y);

// Session::donors(): as text, one line each, and as [{"reuse", "x", "y" or "entry", "shift",
// "confidence", "mis_weight", "share", "jacobian", "selected"}, ...] with null for unknown values.
std::string probedDonorsText(const Session& session, uint32_t x, uint32_t y);
nlohmann::ordered_json probedDonorsJson(const Session& session, uint32_t x, uint32_t y);

// Session::path(): as text, one line each, and as [{"name", "position", "direction", "film",
// "reconnected"},
// ...]; the film of a vertex behind the camera is null.
std::string probedPathText(const Session& session, uint32_t x, uint32_t y);
nlohmann::ordered_json probedPathJson(const Session& session, uint32_t x, uint32_t y);

}  // namespace restlab
