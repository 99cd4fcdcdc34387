// Output files of `run`: summary.csv, tables, images, and names of blocks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// Returns a heading and one row per method; unknown numbers are "nan".
std::string summaryCsv(const Suite& suite, const std::vector<MethodSummary>& rows);

// Returns the table of one block in markdown.
std::string blockTable(const Suite& suite, const std::vector<MethodSummary>& rows);

// Returns the same for LaTeX with booktabs: time, error and their ratios, the best counting rows in
// bold.
std::string blockTex(const Suite& suite, const std::vector<MethodSummary>& rows);

// Writes EXR and PNG of the reference and of every method's measured frame of run 0. All previews
// of a block have one exposure.
void writeBlockImages(const std::filesystem::path& folder, const Suite& suite,
                      const BlockResult& block, float exposure);

// Returns "cornell-box-all", followed by the point of a sweep; for file names.
std::string blockLabel(const Suite& suite, const BlockResult& block);
// Adds camera and size: the name of the block's reference in a folder of results.
std::string referenceLabel(const Suite& suite, const BlockResult& block);

}  // namespace restlab
