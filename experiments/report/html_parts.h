// Parts of report.html, made from a checked model. All text of the model is escaped.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/report/report_model.h"

namespace restlab::html {

// First table of a block: sortable headings, the best of each column marked, rows that do not count
// marked. Below it the columns that are equal in all rows, notes on rows, and the meaning of the
// columns. "" without columns.
std::string resultTable(const ReportModel& block);
// The other columns, behind a line that opens; "" if there are none.
std::string detailTables(const ReportModel& block);

// Notes, each as markup: one is shown, several are a line that opens. "" without notes.
std::string noteList(const std::vector<std::string>& notes);
// The same of a list of texts.
std::string noteList(const ReportModel& texts);
// Warnings and flags of the rows; warnings are always shown.
std::string rowNotes(const ReportModel& block);

// Settings of each method, and the features that the kernels leave out: those of all methods once.
// Both are "" if the block has none.
std::string settingsList(const ReportModel& block);
std::string leftOutList(const ReportModel& block);

// Counts of numerical health; a count above 0 in a column that is "bad" is marked. Counts that are
// equal in all rows are said once.
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
