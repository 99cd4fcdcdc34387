// Settings of the methods, features that their kernels leave out, and counts of health.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "experiments/report/html_box.h"
#include "experiments/report/html_parts.h"
#include "experiments/report/table_layout.h"
#include "experiments/report/text.h"

namespace restlab::html {
namespace {

struct HealthColumn {
  std::string name, help;
  bool isBad = false;
  std::vector<uint64_t> counts;  // by row

  // Returns whether one count says it all. A fault is always shown beside its method.
  bool isOnce() const {
    const bool isSame = std::all_of(counts.begin(), counts.end(),
                                    [&](uint64_t count) { return count == counts.front(); });
    return isSame && (counts.front() == 0 || (counts.size() > 1 && !isBad));
  }
};

std::vector<HealthColumn> healthColumnsOf(const ReportModel& health) {
  std::vector<HealthColumn> columns;
  for (const ReportModel& from : health["columns"]) {
    HealthColumn& column = columns.emplace_back();
    const bool isName = from.is_string();
    column.name = isName ? from.get<std::string>() : reportText(from, "name");
    column.help = isName ? "" : reportText(from, "help");
    column.isBad = !isName && from.value("bad", false);
    for (const ReportModel& row : health["rows"])
      column.counts.push_back(row["counts"][columns.size() - 1].get<uint64_t>());
  }
  return columns;
}

std::string countCell(const HealthColumn& column, size_t row) {
  const uint64_t count = column.counts[row];
  return fmt::format("<td class=\"num{}\" data-value=\"{}\">{}</td>",
                     count == 0     ? " zero"
                     : column.isBad ? " bad"
                                    : "",
                     count, groupedDigits(count));
}

std::string chips(const std::vector<std::string>& features) {
  if (features.empty()) return "";
  std::string list;
  for (const std::string& feature : features)
    list += fmt::format("<li>{}</li>", escapeMarkup(feature));
  return fmt::format("<ul class=\"chips\">{}</ul>\n", list);
}

// A list of features, and the names of the methods that have it.
struct FeatureGroup {
  std::vector<std::string> features, methods;
};

// Returns the features of each method without those of `common`; methods of one list together.
std::vector<FeatureGroup> groupsBeside(const ReportModel& entries,
                                       const std::vector<std::string>& common) {
  std::vector<FeatureGroup> groups;
  for (const ReportModel& entry : entries) {
    std::vector<std::string> rest;
    for (const ReportModel& feature : entry["features"]) {
      const std::string name = feature.get<std::string>();
      if (std::find(common.begin(), common.end(), name) == common.end()) rest.push_back(name);
    }
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const FeatureGroup& other) { return other.features == rest; });
    if (group == groups.end()) group = groups.insert(groups.end(), {rest, {}});
    group->methods.push_back(reportText(entry, "method"));
  }
  return groups;
}

// Returns the features that all methods leave out.
std::vector<std::string> commonFeatures(const ReportModel& entries) {
  std::vector<std::string> common;
  for (const ReportModel& feature : entries.front()["features"]) {
    const bool isCommon = std::all_of(entries.begin(), entries.end(), [&](const auto& entry) {
      const ReportModel& all = entry["features"];
      return std::find(all.begin(), all.end(), feature) != all.end();
    });
    if (isCommon) common.push_back(feature.get<std::string>());
  }
  return common;
}

}  // namespace

std::string healthTable(const ReportModel& block) {
  const auto health = block.find("health");
  if (health == block.end() || (*health)["rows"].empty()) return "";
  SaidOnce once;
  std::vector<HealthColumn> shown;
  std::vector<double> widths;
  for (HealthColumn& column : healthColumnsOf(*health)) {
    if (column.isOnce()) {
      const uint64_t count = column.counts.front();
      once.add(column.name, column.help, count == 0 ? "" : groupedDigits(count));
      continue;
    }
    std::vector<CellLines> cells;
    for (const uint64_t count : column.counts) cells.push_back({groupedDigits(count), "", ""});
    widths.push_back(columnWidth(column.name, cells));
    shown.push_back(std::move(column));
  }
  std::string tables;
  size_t from = 0;
  for (const size_t count : splitToFit(widths)) {
    std::string head = headCell({.title = "method", .isNumber = false}), body;
    for (size_t i = from; i < from + count; ++i)
      head += headCell({.title = shown[i].name, .help = shown[i].help});
    for (size_t row = 0; row < (*health)["rows"].size(); ++row) {
      body += fmt::format("<tr><th scope=\"row\">{}</th>",
                          escapeMarkup(reportText((*health)["rows"][row], "method")));
      for (size_t i = from; i < from + count; ++i) body += countCell(shown[i], row);
      body += "</tr>\n";
    }
    tables += tableBox("health", "Numerical health: " + reportText(block, "title"), head, body);
    from += count;
  }
  return "<h3>Numerical health</h3>\n" + tables + once.paragraph();
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
  const ReportModel& entries = reportList(block, "left_out");
  if (entries.empty()) return "";
  const std::vector<std::string> common = commonFeatures(entries);
  const std::vector<FeatureGroup> groups = groupsBeside(entries, common);
  std::string rows;
  // A single group has no features but the common ones.
  for (size_t i = 0; groups.size() > 1 && i < groups.size(); ++i) {
    const auto& [features, methods] = groups[i];
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                        escapeMarkup(fmt::format("{}", fmt::join(methods, ", "))),
                        features.empty() ? "nothing" : chips(features));
  }
  const std::string beside = fmt::format(
      "{}<div class=\"scroll\"><table class=\"left-out\"><tbody>\n{}</tbody></table></div>\n",
      common.empty() ? "" : "<p class=\"hint\">Beside these:</p>\n", rows);
  return fmt::format(
      "<h3>Left out of the kernels</h3>\n<p class=\"hint\">Features that this scene does not need, "
      "and that the kernels of {} were compiled without.</p>\n{}{}",
      common.empty() ? "each method" : "all methods", chips(common), rows.empty() ? "" : beside);
}

}  // namespace restlab::html
