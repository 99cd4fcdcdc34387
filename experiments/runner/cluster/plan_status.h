// `status` of a plan.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/runner/cluster/plan.h"

namespace restlab {

// Returns what is done, at work, ended without a result and missing, by reference and table, and
// the scheduler's queue where there is one.
nlohmann::ordered_json planStatus(const std::filesystem::path& folder, const Plan& plan);

// Returns the same as lines.
std::string planStatusText(const nlohmann::ordered_json& status);

}  // namespace restlab
