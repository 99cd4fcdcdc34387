// The parts of report.html, from a checked model. All text of the model is escaped.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "experiments/report/report_model.h"

namespace restlab::html {

// The table of a block: sortable headings, the best of each column marked, rows that do not count
// marked with why; below it what the columns mean. "" without columns.
std::string resultTable(const ReportModel& block);

// What the kernels of each method left out; "" where nothing is said.
// What each method was given.
std::string settingsList(const ReportModel& block);
std::string leftOutList(const ReportModel& block);

// Counts of numerical health; a count above 0 in a column that is "bad" is marked.
std::string healthTable(const ReportModel& block);

// Plots and bars as figures, each an SVG in the page.
std::string plotFigures(const ReportModel& block);

// The container of the viewer of block `index` and, in scripts that do not run, what it shows: the
// EXR files below `folder`. Each image holds at most `limit` pixels. Writes nothing where the block
// has no images. Throws Error (badInput) naming a file that cannot be read, holds no R, G, B, or
// differs in size from the first.
void writeImages(std::ostream& out, const ReportModel& block, size_t index,
                 const std::filesystem::path& folder, size_t limit);

// Heading, question, notes and, for several blocks, links to them.
std::string reportHead(const ReportModel& model);

// Provenance, and what the file holds of the images.
std::string reportFoot(const ReportModel& model, size_t limit);

}  // namespace restlab::html
