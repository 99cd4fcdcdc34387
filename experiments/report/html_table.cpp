#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "experiments/report/html_box.h"
#include "experiments/report/html_parts.h"
#include "experiments/report/table_layout.h"
#include "experiments/report/text.h"

namespace restlab::html {
namespace {

bool counts(const ReportModel& row) { return row.value("counts", true); }

bool isRanked(const ReportModel& row, const ReportModel* cell) {
  return cell && counts(row) && cell->value("ranked", true);
}

// Returns the best finite value of a column among at least two rows that count; NaN if there is
// none, or if its interval overlaps another row's.
double bestValue(const ReportModel& block, const ReportModel& column) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::string better = column.value("better", "none");
  if (better == "none") return kNone;
  struct Range {
    double value, nearest, farthest;  // interval's ends, seen from the better side
  };
  const double sign = better == "lower" ? 1.0 : -1.0;
  std::vector<Range> ranges;
  for (const ReportModel& row : block["rows"]) {
    const ReportModel* cell = cellOf(row, column["key"].get<std::string>());
    if (!isRanked(row, cell)) continue;
    const double value = reportNumber((*cell)["value"]);
    if (!std::isfinite(value)) continue;
    const double lo = reportNumber(*cell, "lo", value), hi = reportNumber(*cell, "hi", value);
    const double ends[] = {sign * (std::isnan(lo) ? value : lo),
                           sign * (std::isnan(hi) ? value : hi)};
    ranges.push_back({value, std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
  }
  if (ranges.size() < 2) return kNone;
  const auto isBetter = [&](const Range& a, const Range& b) {
    return sign * a.value < sign * b.value;
  };
  std::sort(ranges.begin(), ranges.end(), isBetter);
  for (size_t i = 1; i < ranges.size(); ++i) {
    // Equal values do not compete: the same method may be listed twice.
    if (ranges[i].value != ranges[0].value && ranges[i].nearest <= ranges[0].farthest) return kNone;
  }
  return ranges[0].value;
}

// Returns the sort key for the script: all digits; "" for NaN, which stays last.
std::string sortValue(double value) {
  if (std::isnan(value)) return "";
  if (std::isinf(value)) return value > 0.0 ? "Infinity" : "-Infinity";
  return fmt::format("{:.17g}", value);
}

// Returns the lines of a cell as markup.
std::string linesHtml(const CellLines& lines) {
  std::string html = lines.value;
  for (const std::string& line : {lines.interval, lines.note})
    if (!line.empty()) html += fmt::format(" <span class=\"ci\">{}</span>", escapeMarkup(line));
  return html;
}

std::string cellHtml(const ReportModel* cell, int digits, double best) {
  if (!cell) return "<td class=\"num none\" data-value=\"\">\xe2\x80\x93</td>";
  const double value = reportNumber((*cell)["value"]);
  return fmt::format("<td class=\"num{}\" data-value=\"{}\">{}</td>", value == best ? " best" : "",
                     sortValue(value), linesHtml(cellLines(*cell, digits)));
}

std::string rowHead(const ReportModel& row) {
  return fmt::format("<th scope=\"row\"><span class=\"method\">{}</span>{}</th>",
                     escapeMarkup(reportText(row, "method")),
                     counts(row) ? "" : " <span class=\"badge\">does not count</span>");
}

std::string columnHelp(const ReportModel& block) {
  std::string list;
  for (const ReportModel& column : block["columns"]) {
    const std::string help = reportText(column, "help");
    if (help.empty()) continue;
    list += fmt::format("<dt>{}</dt><dd>{}</dd>", escapeMarkup(reportText(column, "title")),
                        escapeMarkup(help));
  }
  if (list.empty()) return "";
  return fmt::format(
      "<details class=\"columns\"><summary>What the columns mean</summary><dl>{}</dl></details>\n",
      list);
}

// Returns a table of some columns; "" without columns.
std::string tableOf(const ReportModel& block, const ReportColumns& columns, const char* label) {
  if (columns.empty()) return "";
  const std::string rows = reportText(block, "row_title");
  std::string head = headCell({.title = rows.empty() ? "method" : rows, .isNumber = false});
  std::vector<double> best;
  for (const ReportModel* column : columns) {
    head += headCell({reportText(*column, "title"), reportText(*column, "unit"),
                      reportText(*column, "help"), column->value("better", "none")});
    best.push_back(bestValue(block, *column));
  }
  std::string body;
  for (const ReportModel& row : block["rows"]) {
    body += fmt::format("<tr{}>{}", counts(row) ? "" : " class=\"no\"", rowHead(row));
    for (size_t i = 0; i < columns.size(); ++i) {
      const ReportModel* cell = cellOf(row, (*columns[i])["key"].get<std::string>());
      body += cellHtml(cell, columns[i]->value("digits", kDigits),
                       isRanked(row, cell) ? best[i] : std::nan(""));
    }
    body += "</tr>\n";
  }
  return tableBox("results", fmt::format("{}: {}", label, reportText(block, "title")), head, body);
}

// Returns a sentence on the columns that are equal in all rows.
std::string equalColumns(const ReportModel& block, const ReportColumns& columns) {
  SaidOnce once;
  for (const ReportModel* column : columns) {
    const ReportModel& cell = *cellOf(block["rows"][0], (*column)["key"].get<std::string>());
    const std::string unit = reportText(*column, "unit");
    const CellLines lines = cellLines(cell, column->value("digits", kDigits));
    const bool isZero = reportNumber(cell["value"]) == 0.0 && lines.interval.empty();
    const std::string shown = linesHtml(lines) + (unit.empty() ? "" : " " + escapeMarkup(unit));
    once.add(reportText(*column, "title"), reportText(*column, "help"), isZero ? "" : shown);
  }
  return once.paragraph();
}

}  // namespace

std::string resultTable(const ReportModel& block) {
  if (block["columns"].empty()) return "";
  const TableLayout layout = layOutTable(block);
  return tableOf(block, layout.first, "Results") + equalColumns(block, layout.once) +
         rowNotes(block) + columnHelp(block);
}

std::string detailTables(const ReportModel& block) {
  std::string tables;
  for (const ReportColumns& columns : layOutTable(block).details)
    tables += tableOf(block, columns, "Details");
  if (tables.empty()) return "";
  return fmt::format(
      "<details class=\"more\"><summary>Details: further columns</summary>\n{}"
      "</details>\n",
      tables);
}

}  // namespace restlab::html
