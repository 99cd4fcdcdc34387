#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "experiments/report/html_parts.h"
#include "experiments/report/text.h"

namespace restlab::html {
namespace {

bool counts(const ReportModel& row) { return row.value("counts", true); }

// Returns a cell of a row, or null.
const ReportModel* cellOf(const ReportModel& row, const std::string& key) {
  const auto found = row["cells"].find(key);
  return found == row["cells"].end() ? nullptr : &*found;
}

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

std::string cellHtml(const ReportModel* cell, int digits, double best) {
  if (!cell) return "<td class=\"num none\" data-value=\"\">\xe2\x80\x93</td>";
  const double value = reportNumber((*cell)["value"]);
  std::string shown = shortNumber(value, digits);
  const std::string interval = intervalText(reportNumber(*cell, "lo", std::nan("")),
                                            reportNumber(*cell, "hi", std::nan("")), digits);
  if (!interval.empty()) shown += fmt::format(" <span class=\"ci\">{}</span>", interval.substr(1));
  const std::string note = reportText(*cell, "note");
  if (!note.empty()) shown += fmt::format(" <span class=\"ci\">{}</span>", escapeMarkup(note));
  return fmt::format("<td class=\"num{}\" data-value=\"{}\">{}</td>", value == best ? " best" : "",
                     sortValue(value), shown);
}

std::string rowHead(const ReportModel& row) {
  return fmt::format("<th scope=\"row\"><span class=\"method\">{}</span>{}</th>",
                     escapeMarkup(reportText(row, "method")),
                     counts(row) ? "" : " <span class=\"badge\">does not count</span>");
}

// Lists flags below the table, where lines are long enough to be read; a flag of several rows once.
std::string flagList(const ReportModel& block) {
  struct Said {
    std::string flag;
    bool counts;
    std::string methods;
  };
  std::vector<Said> all;
  for (const ReportModel& row : block["rows"]) {
    const std::string method =
        fmt::format("<span class=\"method\">{}</span>", escapeMarkup(reportText(row, "method")));
    for (const ReportModel& flag : reportList(row, "flags")) {
      const std::string text = escapeMarkup(flag.get<std::string>());
      const auto same = std::find_if(all.begin(), all.end(), [&](const Said& said) {
        return said.flag == text && said.counts == counts(row);
      });
      if (same == all.end()) {
        all.push_back({text, counts(row), method});
      } else {
        same->methods += ", " + method;
      }
    }
  }
  std::string list;
  for (const Said& said : all) {
    list += fmt::format("<li{}>{}: {}</li>", said.counts ? "" : " class=\"no\"", said.methods,
                        said.flag);
  }
  return list.empty() ? "" : fmt::format("<ul class=\"flags\">{}</ul>\n", list);
}

std::string columnHead(const ReportModel& column) {
  const std::string unit = reportText(column, "unit"), help = reportText(column, "help");
  return fmt::format(
      "<th scope=\"col\" class=\"num\" aria-sort=\"none\" data-better=\"{}\"><button "
      "type=\"button\"{}>{}{}</button></th>",
      column.value("better", "none"),
      help.empty() ? "" : fmt::format(" title=\"{}\"", escapeMarkup(help)),
      escapeMarkup(reportText(column, "title")),
      unit.empty() ? "" : fmt::format(" <span class=\"unit\">{}</span>", escapeMarkup(unit)));
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

// Returns the table of the detail columns, or of the others; "" if there are none.
std::string tableOf(const ReportModel& block, bool isDetail) {
  const std::string rows = reportText(block, "row_title");
  std::string head =
      fmt::format("<th scope=\"col\" aria-sort=\"none\"><button type=\"button\">{}</button></th>",
                  rows.empty() ? "method" : escapeMarkup(rows));
  std::vector<std::pair<const ReportModel*, double>> columns;  // columns with their best values
  for (const ReportModel& column : block["columns"]) {
    if (column.value("detail", false) != isDetail) continue;
    head += columnHead(column);
    columns.emplace_back(&column, bestValue(block, column));
  }
  if (columns.empty()) return "";
  std::string body;
  for (const ReportModel& row : block["rows"]) {
    body += fmt::format("<tr{}>{}", counts(row) ? "" : " class=\"no\"", rowHead(row));
    for (const auto& [column, best] : columns) {
      const ReportModel* cell = cellOf(row, (*column)["key"].get<std::string>());
      body += cellHtml(cell, column->value("digits", kDigits),
                       isRanked(row, cell) ? best : std::nan(""));
    }
    body += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}: {}\">\n"
      "<table "
      "class=\"results\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table></div>\n",
      isDetail ? "Details" : "Results", escapeMarkup(reportText(block, "title")), head, body);
}

}  // namespace

std::string resultTable(const ReportModel& block) {
  if (block["columns"].empty()) return "";
  const std::string details = tableOf(block, true);
  return tableOf(block, false) + flagList(block) +
         (details.empty() ? "" : "<h3>Details</h3>\n" + details) + columnHelp(block);
}

std::string healthTable(const ReportModel& block) {
  const auto health = block.find("health");
  if (health == block.end() || (*health)["rows"].empty()) return "";
  std::string head =
      "<th scope=\"col\" aria-sort=\"none\"><button type=\"button\">method</button></th>";
  std::vector<bool> bad;
  for (const ReportModel& column : (*health)["columns"]) {
    const bool isName = column.is_string();
    const std::string help = isName ? "" : reportText(column, "help");
    bad.push_back(!isName && column.value("bad", false));
    head += fmt::format(
        "<th scope=\"col\" class=\"num\" aria-sort=\"none\"><button type=\"button\"{}>{}</button>"
        "</th>",
        help.empty() ? "" : fmt::format(" title=\"{}\"", escapeMarkup(help)),
        escapeMarkup(isName ? column.get<std::string>() : reportText(column, "name")));
  }
  std::string body;
  for (const ReportModel& row : (*health)["rows"]) {
    body += fmt::format("<tr><th scope=\"row\">{}</th>", escapeMarkup(reportText(row, "method")));
    for (size_t i = 0; i < bad.size(); ++i) {
      const uint64_t count = row["counts"][i].get<uint64_t>();
      const char* mark = count == 0 ? " zero" : bad[i] ? " bad" : "";
      body += fmt::format("<td class=\"num{}\" data-value=\"{}\">{}</td>", mark, count,
                          groupedDigits(count));
    }
    body += "</tr>\n";
  }
  return fmt::format(
      "<h3>Numerical health</h3>\n<div class=\"scroll\" role=\"region\" tabindex=\"0\" "
      "aria-label=\"Numerical health: {}\">\n<table class=\"health\">\n<thead><tr>{}</tr></thead>\n"
      "<tbody>\n{}</tbody>\n</table></div>\n",
      escapeMarkup(reportText(block, "title")), head, body);
}

std::string settingsList(const ReportModel& block) {
  std::string rows;
  for (const ReportModel& entry : reportList(block, "settings")) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                        escapeMarkup(reportText(entry, "method")),
                        escapeMarkup(reportText(entry, "text")));
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<h3>Settings of the methods</h3>\n<p class=\"hint\">What is not named has its default "
      "(restlab list integrators, caches, denoisers).</p>\n<div class=\"scroll\">"
      "<table class=\"settings\"><tbody>\n{}</tbody></table></div>\n",
      rows);
}

std::string leftOutList(const ReportModel& block) {
  std::string rows;
  for (const ReportModel& entry : reportList(block, "left_out")) {
    std::string features;
    for (const ReportModel& feature : entry["features"]) {
      features += fmt::format("<li>{}</li>", escapeMarkup(feature.get<std::string>()));
    }
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                        escapeMarkup(reportText(entry, "method")),
                        features.empty() ? "nothing" : "<ul class=\"chips\">" + features + "</ul>");
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<h3>Left out of the kernels</h3>\n<p class=\"hint\">Features that this scene does not need, "
      "and that the kernels of each method were compiled without.</p>\n<div class=\"scroll\">"
      "<table class=\"left-out\"><tbody>\n{}</tbody></table></div>\n",
      rows);
}

}  // namespace restlab::html
