// docs/reference.md: verbs with their options, settings, parts with their parameters, columns and
// metrics, as the program has them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace restlab {

// Returns the page as Markdown. `app`: the root, with all verbs.
std::string referencePage(const CLI::App& app);

}  // namespace restlab
