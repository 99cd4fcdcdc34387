// table.md: the table of each scene and component, with notes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/tables/column_groups.h"
#include "experiments/runner/tables/columns.h"
#include "experiments/runner/tables/disturbed.h"
#include "experiments/runner/tables/markdown_cells.h"
#include "experiments/runner/tables/markdown_table.h"
#include "experiments/runner/tables/report.h"
#include "experiments/runner/tables/row_notes.h"

namespace restlab {

namespace {

constexpr uint32_t kFewRuns = 4;

std::string markedName(const MethodSummary& row) {
  return oneLine(row.method->name) + (row.counts ? "" : " (*)");
}
std::string plainName(const MethodSummary& row) { return row.method->name; }

// Column of a table and the form of its cells.
struct Shown {
  const Column* column;
  MarkdownCell cell;
};

// Table of a block's rows. The columns must outlive it.
class RowTable {
 public:
  RowTable(const Columns& columns, const std::vector<MethodSummary>& rows)
      : columns_(columns), rows_(rows) {}

  RowTable& show(const Column& column, MarkdownCell cell) {
    shown_.push_back({&column, cell});
    return *this;
  }
  RowTable& show(const std::string& key, MarkdownCell cell) {
    return show(columnAt(columns_, key), cell);
  }
  // Returns the table; "" without rows. `isIn`: null for all rows.
  std::string text(std::string (*nameOf)(const MethodSummary&),
                   bool (*isIn)(const MethodSummary&) = nullptr) const {
    std::vector<std::string> heads = {"method"};
    for (const Shown& shown : shown_) {
      const Column& column = *shown.column;
      heads.push_back(column.narrow.empty() ? column.title : column.narrow);
    }
    MarkdownTable table(heads);
    for (const MethodSummary& row : rows_) {
      if (isIn && !isIn(row)) continue;
      std::vector<std::string> cells = {nameOf(row)};
      for (const Shown& shown : shown_) cells.push_back(shown.cell(columns_, *shown.column, row));
      table.add(std::move(cells));
    }
    return table.isEmpty() ? "" : table.text();
  }

 private:
  const Columns& columns_;
  const std::vector<MethodSummary>& rows_;
  std::vector<Shown> shown_;
};

// Names the backend if all methods run on the same one and it is not "cpu". Otherwise method names
// do.
std::string onBackend(const Suite& suite) {
  const std::vector<std::string> backends = suite.methodBackends();
  return backends.size() == 1 && backends[0] != "cpu" ? fmt::format("Backend {}. ", backends[0])
                                                      : "";
}

// Returns slopes and speed-ups; "" if nothing was accumulated.
std::string accumulatedTable(const Columns& columns, const std::vector<MethodSummary>& rows,
                             const std::string& against) {
  const std::string table = RowTable(columns, rows)
                                .show("accumulated_frames", textCell)
                                .show("accumulated_ms", timeCell)
                                .show("accumulated_mse", numberCell)
                                .show("accumulated_slope", numberOrNoneCell)
                                .show("accumulated_line", textCell)
                                .show("equal_time_mse_ratio", lowerCell)
                                .show("equal_error_time_ratio", fasterCell)
                                .text(plainName, [](const MethodSummary& row) {
                                  return row.convergence && !row.convergence->points.empty();
                                });
  if (table.empty()) return "";
  return "\nFrames accumulated, time from the beginning of the history; slopes and ratios are of "
         "lines fitted to log(MSE) over log(time)" +
         (against.empty() ? "" : "; against " + against) + ":\n\n" + table;
}

// Returns the suite's further metrics and masks; "" if there are none.
std::string figuresTable(const Columns& columns, const std::vector<MethodSummary>& rows) {
  const Columns figures = figureColumns(*rows.front().suite);
  RowTable table(columns, rows);
  bool isAny = false;
  for (const Column& column : figures) {
    if (!isKnown(column, rows)) continue;
    table.show(column, numberCell);
    isAny = true;
  }
  return isAny ? "\nOf the measured frame:\n\n" + table.text(plainName) : "";
}

std::string temporalTable(const Columns& columns, const std::vector<MethodSummary>& rows) {
  RowTable shown(columns, rows);
  shown.show("temporal_variance", numberOrNoneCell)
      .show("temporal_difference", numberOrNoneCell)
      .show("temporal_error_difference_squared", numberOrNoneCell);
  for (const int lag : {1, 2, 4, 8})
    shown.show(fmt::format("error_autocorrelation_{}", lag), numberOrNoneCell);
  const std::string table =
      shown.text(plainName, [](const MethodSummary& row) { return row.temporal.has_value(); });
  if (table.empty()) return "";
  std::string moved;
  for (const MethodSummary& row : rows) {
    if (!row.temporal || !row.suite->hasMovingCamera()) continue;
    const Column& column = columnAt(columns, "temporal_difference_of_reference");
    moved = "; the two references differ by " + shortNumber(numberOf(column, row).value);
  }
  return "\nOver the timed frames of a run: variance of a pixel, mean absolute difference of frames"
         ", mean squared change of errors, correlation of errors by the number of frames between "
         "them" +
         moved + ":\n\n" + table;
}

// Returns the main table: time and error of each row.
std::string errorTable(const Columns& columns, const std::vector<MethodSummary>& rows) {
  return RowTable(columns, rows)
      .show("time_ms_median", timeAndRatioCell)
      .show("mse", numberCell)
      .show("mse_ratio", lowerCell)
      .show("average_mse_ratio", lowerCell)
      .show("energy_ratio", numberCell)
      .text(markedName);
}

// Returns the parts of the error, and the efficiency.
std::string detailsTable(const Columns& columns, const std::vector<MethodSummary>& rows) {
  return "\n" +
         RowTable(columns, rows)
             .show("efficiency_ratio", ratioCell)
             .show("bias_share_of_mse", signedShareCell)
             .show("variance", knownCell)
             .show("worst_0.1pct_share_of_mse", shareCell)
             .show("rays_per_pixel", valueOrNoneCell)
             .show("time_ratio_to_first_backend", timesCell)
             .text(markedName) +
         "\n" +
         RowTable(columns, rows)
             .show("mse_without_lights", mseAndRatioCell)
             .show("relmse_e1e-2_trim0.1", relmseAndRatioCell)
             .text(markedName);
}

// Returns one line per age, one column per method; "" if nothing is known.
std::string agesTable(const std::vector<MethodSummary>& rows, const std::string& against,
                      Interval (*ratio)(const AgeSummary&)) {
  std::vector<const MethodSummary*> known;
  for (const MethodSummary& row : rows) {
    const bool isOne = std::all_of(row.ages.begin(), row.ages.end(), [&](const AgeSummary& age) {
      const Interval of = ratio(age);
      return std::isnan(of.value) || (of.value == 1.0 && of.lo == 1.0 && of.hi == 1.0);
    });
    if (!isOne) known.push_back(&row);
  }
  if (known.empty()) return "";
  std::vector<std::string> heads = {"frame"};
  for (const MethodSummary* row : known) heads.push_back(markedName(*row));
  MarkdownTable table(heads);
  for (size_t i = 0; i < known.front()->ages.size(); ++i) {
    std::vector<std::string> cells = {std::to_string(known.front()->ages[i].age)};
    for (const MethodSummary* row : known) {
      const Interval of = ratio(row->ages[i]);
      cells.push_back(std::isnan(of.value) ? "" : ratioWithEnds(of));
    }
    table.add(std::move(cells));
  }
  return fmt::format(
             "\nMSE of {} over MSE, by the number of frames since the view stands still; above 1: "
             "lower error:\n\n",
             against) +
         table.text();
}

}  // namespace

std::string blockTable(const Suite& suite, const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const BlockResult& block = *rows.front().block;
  std::string text = fmt::format(
      "## {}, {} light{}\n\n{}Camera {}{}{}, {}x{}, {}; "
      "{} of {} warm-up and {} timed frames; reference {}.\n\n",
      block.scene, componentName(block.component), suite.point.empty() ? "" : ", " + suite.point,
      onBackend(suite), block.camera,
      suite.hasMovingCamera() ? fmt::format(" on the path '{}'", suite.cameraPathName) : "",
      suite.events.empty() ? "" : ", lights: " + eventsText(suite.events, suite.warmupFrames),
      block.width, block.height, transportLine(suite), counted(rows.front().runs, "run"),
      suite.warmupFrames, suite.timedFrames, originOf(block.reference));
  const Columns columns = columnsOf(rows);
  text += errorTable(columns, rows);
  std::string notes;
  if (rows.front().runs < kFewRuns) {
    notes += fmt::format(
        "- {}: intervals of fewer than {} say little\n",
        rows.front().runs == 1 ? "one run" : fmt::format("{} runs", rows.front().runs), kFewRuns);
  }
  notes += disturbedNote(rows);
  notes += rowNotes(rows);
  text += detailsTable(columns, rows);
  text += agesTable(rows, suite.baselineName(), [](const AgeSummary& age) { return age.mseRatio; });
  text += agesTable(rows, suite.averageName(),
                    [](const AgeSummary& age) { return age.ratioToAverage; });
  text += figuresTable(columns, rows);
  text += accumulatedTable(columns, rows, suite.baselineName());
  text += temporalTable(columns, rows);
  if (!block.reference.half0) {
    notes += "- the reference has no halves: its own noise is part of every MSE\n";
  }
  return text + (notes.empty() ? "" : "\n" + notes) + "\n";
}

}  // namespace restlab
