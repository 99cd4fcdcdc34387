// One function per verb that adds it to the command line; its callback does the work and may throw.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace restlab {

// Result of a verb's callback.
struct Outcome {
  ExitCode code = ExitCode::ok;
  std::vector<std::string> argv;  // the whole command line, for records
};

using Action = std::function<void(Outcome&)>;

// Return the action that runs if the verb was given.
Action addRunVerb(CLI::App& app);
Action addStatusVerb(CLI::App& app);
Action addReportVerb(CLI::App& app);
Action addCleanVerb(CLI::App& app);
Action addPlanVerb(CLI::App& app);
Action addWorkVerb(CLI::App& app);
Action addCollectVerb(CLI::App& app);
Action addSubmitVerb(CLI::App& app);
Action addRenderVerb(CLI::App& app);
Action addReferenceVerb(CLI::App& app);
Action addCompareVerb(CLI::App& app);
Action addFigureVerb(CLI::App& app);
Action addDenoiseVerb(CLI::App& app);
Action addInfoVerb(CLI::App& app);
Action addConvertVerb(CLI::App& app);
Action addDistanceFieldVerb(CLI::App& app);
Action addListVerb(CLI::App& app);
Action addBenchVerb(CLI::App& app);
Action addBiasVerb(CLI::App& app);
Action addGraphVerb(CLI::App& app);
Action addBsdfVerb(CLI::App& app);
Action addViewVerb(CLI::App& app);

}  // namespace restlab
