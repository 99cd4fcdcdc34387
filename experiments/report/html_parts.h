// Parts of report.html, made from a checked model. All text of the model is escaped.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "experiments/report/report_model.h"

namespace restlab::html {

// Table of a block: sortable headings, the best of each column marked, rows that do not count
// marked with the reason; below it the meaning of the columns. "" without columns.
std::string resultTable(const ReportModel& block);

// Settings of each method, and the features that the kernels of each method leave out. Both are ""
// if the block has none.
std::string settingsList(const ReportModel& block);
std::string leftOutList(const ReportModel& block);

// Counts of numerical health; a count above 0 in a column that is "bad" is marked.
std::string healthTable(const ReportModel& block);

// Plots and bars as figures, each an SVG in the page.
std::string plotFigures(const ReportModel& block);

// Writes the container of the viewer of block `index` and its data in scripts that do not run: the
// pixels of the EXR files below `folder`, at most `limit` pixels per image. Writes nothing if the
// block has no images. Throws Error (badInput) naming a file that cannot be read, holds no R, G, B,
// or differs in size from the first.
void writeImages(std::ostream& out, const ReportModel& block, size_t index,
                 const std::filesystem::path& folder, size_t limit);

// Heading, question, notes and, if there are several blocks, links to them.
std::string reportHead(const ReportModel& model);

// Provenance, and a note on how the file holds the images.
std::string reportFoot(const ReportModel& model, size_t limit);

}  // namespace restlab::html
