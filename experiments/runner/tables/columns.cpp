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
std::string named(const std::string& title, const Names& names) {
  std::string out;
  for (size_t at = 0; at < title.size(); ++at) {
    const bool isMark = title[at] == '{' && at + 2 < title.size() && title[at + 2] == '}';
    if (!isMark) {
      out += title[at];
      continue;
    }
    const std::string& name = names.at(size_t(title[at + 1] - '0'));
    if (name.empty()) {
      const size_t bracket = out.rfind(" (");
      return out.substr(0, bracket != std::string::npos ? bracket : out.rfind(' '));
    }
    out += name;
    at += 2;
  }
  return out;
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
