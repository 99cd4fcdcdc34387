#include "experiments/runner/tables/columns.h"

#include <array>
#include <cmath>
#include <iterator>

#include "experiments/runner/tables/column_groups.h"

namespace restlab {

namespace {

// Baseline, average and first backend, as titles name them; "" if there is none.
using Names = std::array<std::string, 3>;

// Returns the backend that others are compared with; "first backend" if rows have different ones.
std::string firstBackend(const std::vector<MethodSummary>& rows) {
  const Suite& suite = *rows.front().suite;
  std::string first;
  for (const MethodSummary& row : rows) {
    if (std::isnan(row.timeToFirstBackend.value)) continue;
    const size_t method = size_t(row.method - suite.methods.data());
    const std::string& backend = suite.methods[suite.onFirstBackend(method)].session.backend;
    if (first.empty()) first = backend;
    if (first != backend) first = "first backend";
  }
  return first;
}

// Puts names in a title. Without a name, its bracket or the word goes: "than", "efficiency".
std::string named(std::string title, const Names& names) {
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string mark = "{" + std::to_string(i) + "}";
    size_t at = title.find(mark);
    if (at != std::string::npos && names[i].empty()) {
      const size_t bracket = title.rfind(" (", at);
      return title.substr(0, bracket != std::string::npos ? bracket : title.rfind(' ', at));
    }
    for (; at != std::string::npos; at = title.find(mark, at + names[i].size()))
      title.replace(at, mark.size(), names[i]);
  }
  return title;
}

}  // namespace

Columns columnsOf(const std::vector<MethodSummary>& rows) {
  const Suite& suite = *rows.front().suite;
  const Names names = {suite.baselineName(), suite.averageName(), firstBackend(rows)};
  Columns all;
  for (Columns (*group)() :
       {identityColumns, frameColumns, conditionColumns, accumulatedColumns, temporalColumns}) {
    for (Column& column : group()) {
      for (std::string* text : {&column.title, &column.narrow, &column.tex, &column.help})
        *text = named(std::move(*text), names);
      all.push_back(std::move(column));
    }
  }
  Columns figures = figureColumns(suite), health = healthColumns();
  std::move(figures.begin(), figures.end(), std::back_inserter(all));
  std::move(health.begin(), health.end(), std::back_inserter(all));
  return all;
}

}  // namespace restlab
