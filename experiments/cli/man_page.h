// Pages of the manual (man restlab, man restlab-run), made from the verbs and their options.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace restlab {

// Writes restlab.1 and a page for each verb into a folder, which is made. Throws Error (badInput)
// if it cannot be written to.
void writeManPages(const CLI::App& app, const std::filesystem::path& folder);

}  // namespace restlab
