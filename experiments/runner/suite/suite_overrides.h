// Applies `--set KEY=VALUE` to suites.
#pragma once

#include <string>

#include "core/base/config.h"

namespace restlab {

// Changes a suite's document; see loadSuites(). Throws Error (badUsage) naming the option.
void applyOverride(ConfigTable& root, const std::string& assignment);

}  // namespace restlab
