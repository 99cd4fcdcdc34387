// Which suite, and what of it: options of all verbs that take a suite.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/suite/suite.h"

namespace restlab {

struct SuiteOptions {
  std::string suite, out, scenes, methods;
  std::vector<std::string> overrides, sweeps;
  int threads = -1;  // -1: from the suite
};

void addSuiteOptions(CLI::App& verb, SuiteOptions& options);

// Returns the suite's points with what was chosen. `verb`: its name, for errors. Warns of settings
// without effect and of missing baselines. Throws Error (badUsage).
std::vector<Suite> chosenSuites(const std::string& verb, const SuiteOptions& options);

// Returns the folder that was given, else results/NAME.
std::filesystem::path outFolder(const SuiteOptions& options, const Suite& suite);

// Logs what will be done: points, scenes, methods and runs.
void logChoice(const std::vector<Suite>& points, const std::filesystem::path& out);

}  // namespace restlab
