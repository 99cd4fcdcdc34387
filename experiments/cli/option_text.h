// Options of verbs in words, for the pages and scripts that `restlab list` makes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace restlab {

// Returns whether every verb has the option: --help, --quiet and --verbose.
bool isCommon(const CLI::Option& option);

// Returns a value's range, its choices ("box|center"), or its kind in words; --help has "UINT:from
// 1 to 16384". "" for a flag.
std::string kindOf(const CLI::Option& option);

// Returns "-o", "--output", ..., short ones first; none for what is given by its place alone.
std::vector<std::string> dashedNames(const CLI::Option& option);

// Joins dashedNames(), or returns the name that the help has for what is given by its place.
std::string namesOf(const CLI::Option& option);

}  // namespace restlab
