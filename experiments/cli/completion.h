// Completion of the command line by bash, made from the verbs, their options and the registries.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace restlab {

// Returns a script that bash reads from share/bash-completion/completions. `kinds`: what `list`
// takes. Names of files complete themselves.
std::string bashCompletion(const CLI::App& app, const std::vector<std::string>& kinds);

}  // namespace restlab
