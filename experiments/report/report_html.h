// Writes report.html and plots/*.svg of a report model.
#pragma once

#include <filesystem>

#include "experiments/report/report_model.h"

namespace restlab {

// Writes folder/report.html: one file that opens in any browser without a network. `model` as
// described in report_model.h; its image files are read below `folder`. The file is written
// completely or not at all. Throws Error (badInput) naming a wrong field of the model, an image
// that cannot be used, or a file that cannot be written.
// a file that cannot be written.
void writeReport(const std::filesystem::path& folder, const ReportModel& model);

// Writes folder/plots/BLOCK-PLOT.svg for each plot of the model and folder/plots/BLOCK-bars.svg for
// bars; creates folder/plots. Older files there are kept. Throws as writeReport().
void writePlots(const std::filesystem::path& folder, const ReportModel& model);

}  // namespace restlab
