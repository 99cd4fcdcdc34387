// What `run` leaves in its folder: results.jsonl, summary.csv, table.md, images, run.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// Heading and one row a method; numbers that are unknown are "nan".
std::string summaryCsv(const Suite& suite, const std::vector<MethodSummary>& rows);

// The lecture's table of one block in markdown.
std::string blockTable(const Suite& suite, const std::vector<MethodSummary>& rows);

// The same for LaTeX with booktabs: time, error and their ratios, the best rows that count in bold.
std::string blockTex(const Suite& suite, const std::vector<MethodSummary>& rows);

// EXR and PNG of the reference and of every method's measured frame of run 0. The previews of a
// block have one exposure.
void writeBlockImages(const std::filesystem::path& folder, const Suite& suite,
                      const BlockResult& block, float exposure);

// "cornell-box-all", with the point of a sweep behind it; for file names.
std::string blockLabel(const Suite& suite, const BlockResult& block);
// The same with camera and size: the name of its reference in a folder of results.
std::string referenceLabel(const Suite& suite, const BlockResult& block);

}  // namespace restlab
