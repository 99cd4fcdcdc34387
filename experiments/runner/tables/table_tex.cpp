// table.tex: tables for a paper, with booktabs; the best counting row in bold.
#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/tables/column_groups.h"
#include "experiments/runner/tables/columns.h"
#include "experiments/runner/tables/report.h"

namespace restlab {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : oneLine(text)) {
    switch (c) {
      case '\\':
        out += "\\textbackslash{}";
        break;
      case '~':
        out += "\\textasciitilde{}";
        break;
      case '^':
        out += "\\textasciicircum{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        out += '\\';
        out += c;
        break;
      default:
        out += c;
    }
  }
  return out;
}

// Returns "0.0278"; writes "1.30e-05" as a power of ten.
std::string number(double value, int digits = kDigits) {
  if (std::isnan(value)) return "--";
  if (std::isinf(value)) return value > 0.0 ? "$\\infty$" : "$-\\infty$";
  const std::string plain = shortNumber(value, digits);
  const size_t e = plain.find('e');
  if (e == std::string::npos) return value < 0.0 ? fmt::format("${}$", plain) : plain;
  return fmt::format("${} \\times 10^{{{}}}$", plain.substr(0, e), std::stoi(plain.substr(e + 1)));
}

// Returns the text of intervalText() in a small font; "" if an end is unknown.
std::string ends(const Interval& interval, int digits) {
  if (std::isnan(interval.lo) || std::isnan(interval.hi)) return "";
  const auto end = [&](double of) {
    return std::isinf(of) ? std::string("unbounded") : number(of, digits);
  };
  const bool isOpen = std::isinf(interval.lo) && std::isinf(interval.hi);
  return fmt::format(
      " {{\\scriptsize [{}]}}",
      isOpen ? "unbounded" : fmt::format("{}, {}", end(interval.lo), end(interval.hi)));
}

std::string cell(const Interval& interval, bool isBest, const std::string& unit = "",
                 int digits = kDigits) {
  if (std::isnan(interval.value)) return "";
  const std::string value = number(interval.value, digits) + unit;
  return (isBest ? fmt::format("\\textbf{{{}}}", value) : value) + ends(interval, digits);
}

// Returns the best number of the counting rows; NaN if fewer than two have one, or if none is
// better than another.
double bestOf(const Column& column, const std::vector<MethodSummary>& rows) {
  const double sign = column.better == "higher" ? -1.0 : 1.0;
  double smallest = kUnknown;
  size_t values = 0;
  for (const MethodSummary& row : rows) {
    const double value = sign * numberOf(column, row).value;
    if (!row.counts || !isRanked(column, row) || std::isnan(value)) continue;
    ++values;
    if (!(value >= smallest)) smallest = value;
  }
  return values < 2 || column.better == "none" ? kUnknown : sign * smallest;
}

// Returns the beginning of captions: "scene, all light, max_bounces=2".
std::string subjectOf(const Suite& suite, const BlockResult& block) {
  return fmt::format("{}, {} light{}", escaped(block.scene), componentName(block.component),
                     suite.point.empty() ? "" : ", " + escaped(suite.point));
}

std::string nameCell(const MethodSummary& row) {
  return escaped(row.method->name) + (row.counts ? "" : "$^*$");
}

// Returns the text of a cell. `isBest`: in bold, if the form has it.
using TexCell = std::string (*)(const Columns& columns, const Column& column,
                                const MethodSummary& row, bool isBest);

// Number without its interval; "--" where it is unknown.
std::string valueCell(const Columns&, const Column& column, const MethodSummary& row, bool isBest) {
  const std::string value = number(numberOf(column, row).value);
  return isBest ? fmt::format("\\textbf{{{}}}", value) : value;
}

std::string countCell(const Columns&, const Column& column, const MethodSummary& row, bool) {
  return textOf(column, row);
}

std::string plainCell(const Columns&, const Column& column, const MethodSummary& row, bool) {
  return cell(numberOf(column, row), false, "", column.digits);
}

std::string rankedCell(const Columns&, const Column& column, const MethodSummary& row,
                       bool isBest) {
  return cell(numberOf(column, row), isBest, "", column.digits);
}

// Ratio, with the place at which it was read; "" in the row that it is relative to.
std::string ratioCell(const Columns& columns, const Column& column, const MethodSummary& row,
                      bool) {
  const Interval of = numberOf(column, row);
  if (isItself(column, row) || std::isnan(of.value)) return "";
  const std::string ratio = cell(of, false, "$\\times$");
  if (column.noteKey.empty()) return ratio;
  const Column& place = columnAt(columns, column.noteKey);
  return fmt::format("{} {} {}{}", ratio, column.noteWord, number(numberOf(place, row).value),
                     place.unit.empty() ? "" : " " + place.unit);
}

std::string signedShareCell(const Columns&, const Column& column, const MethodSummary& row, bool) {
  const double share = numberOf(column, row).value;
  return std::isnan(share) ? "--" : fmt::format("${:+.1f}$\\,\\%", share);
}

// Column of a table and the form of its cells.
struct TexColumn {
  const Column* column;
  TexCell cell;
};

// Table of a block's rows. The columns must outlive it.
class TexTable {
 public:
  TexTable(const Columns& columns, const std::vector<MethodSummary>& rows)
      : columns_(columns), rows_(rows) {}

  TexTable& show(const Column& column, TexCell cell) {
    shown_.push_back({&column, cell});
    return *this;
  }
  TexTable& show(const std::string& key, TexCell cell) {
    return show(columnAt(columns_, key), cell);
  }
  bool isEmpty() const { return shown_.empty(); }
  // Returns the table; "" without rows. `notes`: complete lines below it. `isIn`: null for all
  // rows.
  std::string text(const std::string& caption, const std::string& notes = "",
                   bool (*isIn)(const MethodSummary&) = nullptr) const {
    std::string head = "method", lines;
    for (const TexColumn& shown : shown_) {
      const Column& column = *shown.column;
      head += " & " + (column.tex.empty() ? escaped(column.title) : column.tex);
    }
    for (const MethodSummary& row : rows_)
      if (!isIn || isIn(row)) lines += lineOf(row);
    if (lines.empty()) return "";
    return fmt::format(
        "\\begin{{table}}\n\\centering\n\\caption{{{}}}\n\\begin{{tabular}}{{l{}}}\n\\toprule\n"
        "{} \\\\\n\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n{}\\end{{table}}\n\n",
        caption, std::string(shown_.size(), 'r'), head, lines, notes);
  }

 private:
  std::string lineOf(const MethodSummary& row) const {
    std::string line = nameCell(row);
    for (const TexColumn& shown : shown_) {
      const Column& column = *shown.column;
      const bool isBest = row.counts && numberOf(column, row).value == bestOf(column, rows_);
      line += " & " + shown.cell(columns_, column, row, isBest);
    }
    return line + " \\\\\n";
  }

  const Columns& columns_;
  const std::vector<MethodSummary>& rows_;
  std::vector<TexColumn> shown_;
};

// Returns the suite's further metrics and masks, one column each; "" if there are none.
std::string figuresTex(const Columns& columns, const std::vector<MethodSummary>& rows) {
  const Suite& suite = *rows.front().suite;
  const Columns figures = figureColumns(suite);
  TexTable table(columns, rows);
  for (const Column& column : figures)
    if (isKnown(column, rows)) table.show(column, rankedCell);  // else a mask of another scene
  if (table.isEmpty()) return "";
  return table.text(subjectOf(suite, *rows.front().block) +
                    ": further figures of the measured frame");
}

// Returns slopes and speed-ups; "" if nothing was accumulated.
std::string accumulatedTex(const Columns& columns, const std::vector<MethodSummary>& rows) {
  const Suite& suite = *rows.front().suite;
  const std::string caption =
      subjectOf(suite, *rows.front().block) +
      ": frames accumulated; slope of log(MSE) over log(time), MSE times lower at "
      "equal time, times faster to equal MSE" +
      (suite.baselineName().empty() ? "" : ", against " + escaped(suite.baselineName()));
  return TexTable(columns, rows)
      .show("accumulated_frames", countCell)
      .show("accumulated_slope", plainCell)
      .show("equal_time_mse_ratio", ratioCell)
      .show("equal_error_time_ratio", ratioCell)
      .text(caption, "", [](const MethodSummary& row) {
        return row.convergence && !row.convergence->points.empty();
      });
}

// Prints why rows do not count below the table; other flags become comments for the author.
std::string notesOf(const std::vector<MethodSummary>& rows) {
  std::string notes;
  for (const MethodSummary& row : rows) {
    for (const std::string& flag : row.flags) {
      const std::string note = fmt::format("{}: {}", nameCell(row), escaped(flag));
      notes += row.counts ? fmt::format("% {}\n", note)
                          : fmt::format("\\par{{\\footnotesize {}}}\n", note);
    }
  }
  return notes;
}

}  // namespace

std::string blockTex(const Suite& suite, const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const BlockResult& block = *rows.front().block;
  const std::string against = suite.baselineName();
  const std::string caption = fmt::format(
      "{}: {}$\\times${}, {} of {} warm-up and {} timed frames, reference of {} spp (relMSE "
      "{}); {}95\\,\\% intervals",
      subjectOf(suite, block), block.width, block.height, counted(rows.front().runs, "run"),
      suite.warmupFrames, suite.timedFrames, block.reference.spp, number(block.reference.relmse),
      against.empty() ? "" : fmt::format("time and lower against {}; ", escaped(against)));
  const Columns columns = columnsOf(rows);
  return TexTable(columns, rows)
             .show("time_ms_median", valueCell)
             .show("time_ratio", ratioCell)
             .show("mse", rankedCell)
             .show("mse_ratio", ratioCell)
             .show("energy_ratio", plainCell)
             .show("bias_share_of_mse", signedShareCell)
             .text(caption, notesOf(rows)) +
         accumulatedTex(columns, rows) + figuresTex(columns, rows);
}

}  // namespace restlab
