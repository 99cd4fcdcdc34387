// `--set KEY=VALUE` of suites.
#pragma once

#include <string>

#include "core/config.h"

namespace restlab {

// Changes a suite's document as loadSuites() says. Throws Error (badUsage) naming the option.
void applyOverride(ConfigTable& root, const std::string& assignment);

}  // namespace restlab
