// Output files of `run`: summary.csv, tables and images.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/tables/summary.h"

namespace restlab {

// Returns a heading and one row per method; unknown numbers are "nan".
std::string summaryCsv(const std::vector<MethodSummary>& rows);

// Returns the table of one block in markdown.
std::string blockTable(const Suite& suite, const std::vector<MethodSummary>& rows);

// Returns the same for LaTeX with booktabs: time, error and their ratios, the best counting rows in
// bold.
std::string blockTex(const Suite& suite, const std::vector<MethodSummary>& rows);

// Writes EXR and PNG of the reference and of every method's measured frame of run 0. All previews
// of a block have one exposure.
void writeBlockImages(const std::filesystem::path& folder, const Suite& suite,
                      const BlockResult& block, float exposure);

}  // namespace restlab
