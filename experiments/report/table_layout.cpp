#include "experiments/report/table_layout.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "experiments/report/svg_style.h"
#include "experiments/report/text.h"

namespace restlab {
namespace {

// Widths in CSS pixels, as style.css has them: a page in a window of 1280 with a scroll bar, less
// the names of the rows.
constexpr double kRoom = 1160.0, kNames = 240.0;
constexpr double kPadding = 23.0, kArrow = 16.0, kHeading = 14.5;
constexpr double kDigit = 8.5, kSmallDigit = 7.4;  // of the fixed-width font

size_t characters(const std::string& text) {
  return size_t(
      std::count_if(text.begin(), text.end(), [](char c) { return (uint8_t(c) & 0xc0) != 0x80; }));
}

bool isSame(const ReportModel& a, const ReportModel& b) {
  for (const char* key : {"value", "lo", "hi", "note"})
    if (a.value(key, ReportModel()) != b.value(key, ReportModel())) return false;
  return true;
}

bool isSameInAllRows(const ReportModel& block, const ReportModel& column) {
  const std::string key = column["key"].get<std::string>();
  const ReportModel& rows = block["rows"];
  const ReportModel* first = rows.size() < 2 ? nullptr : cellOf(rows[0], key);
  if (!first) return false;
  return std::all_of(rows.begin(), rows.end(), [&](const ReportModel& row) {
    const ReportModel* cell = cellOf(row, key);
    return cell && isSame(*first, *cell);
  });
}

double widthOf(const ReportModel& block, const ReportModel& column) {
  std::vector<CellLines> cells;
  for (const ReportModel& row : block["rows"]) {
    const ReportModel* cell = cellOf(row, column["key"].get<std::string>());
    if (cell) cells.push_back(cellLines(*cell, column.value("digits", kDigits)));
  }
  return columnWidth(reportText(column, "title") + " " + reportText(column, "unit"), cells);
}

std::vector<size_t> splitAt(const std::vector<double>& widths, double room) {
  std::vector<size_t> counts;
  double used = 0.0;
  for (const double width : widths) {
    if (counts.empty() || used + width > room) {
      counts.push_back(0);
      used = 0.0;
    }
    ++counts.back();
    used += width;
  }
  return counts;
}

std::vector<double> widthsOf(const ReportModel& block, const ReportColumns& columns) {
  std::vector<double> widths;
  for (const ReportModel* column : columns) widths.push_back(widthOf(block, *column));
  return widths;
}

}  // namespace

CellLines cellLines(const ReportModel& cell, int digits) {
  const std::string interval = intervalText(reportNumber(cell, "lo", std::nan("")),
                                            reportNumber(cell, "hi", std::nan("")), digits);
  return {shortNumber(reportNumber(cell["value"]), digits),
          interval.empty() ? "" : interval.substr(1), reportText(cell, "note")};
}

const ReportModel* cellOf(const ReportModel& row, const std::string& key) {
  const auto found = row["cells"].find(key);
  return found == row["cells"].end() ? nullptr : &*found;
}

TableLayout layOutTable(const ReportModel& block) {
  TableLayout layout;
  ReportColumns main, same, details;
  for (const ReportModel& column : block["columns"]) {
    const bool isDetail = column.value("detail", false), isOnce = isSameInAllRows(block, column);
    (isDetail ? isOnce ? layout.once : details : isOnce ? same : main).push_back(&column);
  }
  if (main.empty()) {
    main = std::move(same);
  } else {
    layout.once.insert(layout.once.begin(), same.begin(), same.end());
  }
  const std::vector<size_t> fitting = splitAt(widthsOf(block, main), kRoom - kNames);
  const auto end = main.begin() + std::ptrdiff_t(fitting.empty() ? 0 : fitting.front());
  layout.first.assign(main.begin(), end);
  details.insert(details.begin(), end, main.end());
  size_t at = 0;
  for (const size_t count : splitToFit(widthsOf(block, details))) {
    const auto from = details.begin() + std::ptrdiff_t(at);
    layout.details.emplace_back(from, from + std::ptrdiff_t(count));
    at += count;
  }
  return layout;
}

double columnWidth(const std::string& heading, const std::vector<CellLines>& cells) {
  double width = 0.0;
  std::istringstream words(heading);
  for (std::string word; words >> word;)
    width = std::max(width, svg::textWidth(word, kHeading) + kArrow);
  for (const CellLines& cell : cells) {
    width = std::max(width, kDigit * double(characters(cell.value)));
    for (const std::string& line : {cell.interval, cell.note})
      width = std::max(width, kSmallDigit * double(characters(line)));
  }
  return width + kPadding;
}

std::vector<size_t> splitToFit(const std::vector<double>& widths) {
  double room = kRoom - kNames;
  std::vector<size_t> counts = splitAt(widths, room);
  // Tables of about one width: the narrowest room that needs no further table.
  constexpr double kStep = 20.0;
  while (room > kStep) {
    room -= kStep;
    std::vector<size_t> narrower = splitAt(widths, room);
    if (narrower.size() > counts.size()) break;
    counts = std::move(narrower);
  }
  return counts;
}

}  // namespace restlab
