// summary.csv: first the columns that scripts depend on, in a fixed order, then further ones.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/tables/csv.h"
#include "experiments/runner/tables/report.h"

namespace restlab {

namespace {

// RFC 4180: quotes text with a comma or quote; line breaks become blanks.
std::string quoted(const std::string& value) {
  const std::string text = oneLine(value);
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

std::string fieldText(const CsvField& field, const MethodSummary& row) {
  if (field.end == nullptr) return textOf(*field.column, row);
  return exactNumber(std::get<Interval>(field.value(row)).value);
}

std::vector<std::string> namesOfFirst() {
  std::vector<std::string> names = {"scene", "camera"};
  for (const MethodSetting& setting : methodSettings()) names.emplace_back(setting.key);
  for (const char* name :
       {"width", "height", "frames", "runs", "time_ms_median", "time_ms_p95", "mse", "mse_ci_lo",
        "mse_ci_hi", "relmse_e1e-2", "energy_ratio", "nonfinite", "mse_ratio", "time_ratio",
        "efficiency_ratio", "features_left_out"})
    names.emplace_back(name);
  return names;
}

}  // namespace

ColumnValue CsvField::value(const MethodSummary& row) const {
  const ColumnValue all = column->get(row);
  return end == nullptr ? all : only(std::get<Interval>(all).*end);
}

std::vector<CsvField> csvFields(const Columns& columns) {
  std::vector<CsvField> fields;
  for (const Column& column : columns) {
    if (!column.inCsv) continue;
    fields.push_back({&column, nullptr, column.key});
    if (column.ends != Ends::all) continue;
    fields.push_back({&column, &Interval::lo, column.key + "_ci_lo"});
    fields.push_back({&column, &Interval::hi, column.key + "_ci_hi"});
  }
  auto place = fields.begin();
  for (const std::string& name : namesOfFirst()) {
    const auto found = std::find_if(place, fields.end(),
                                    [&](const CsvField& field) { return field.name == name; });
    std::rotate(place, found, found + 1);
    ++place;
  }
  return fields;
}

std::string summaryCsv(const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const Columns columns = columnsOf(rows);
  const std::vector<CsvField> fields = csvFields(columns);
  std::vector<std::string> cells;
  for (const CsvField& field : fields) cells.push_back(quoted(field.name));
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (const MethodSummary& row : rows) {
    cells.clear();
    for (const CsvField& field : fields) cells.push_back(quoted(fieldText(field, row)));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

}  // namespace restlab
