#include "experiments/runner/tables/parameter_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiments/runner/base/files.h"
#include "experiments/runner/base/json_number.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/suite/sweep.h"
#include "experiments/runner/tables/swept_axis.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<SweptValue>;

// Range of values from which their axis is logarithmic.
constexpr double kSweptFarApart = 20.0;

// A number that is swept over: lines of points in the order in which they were measured.
struct SweptLines {
  std::vector<double> values;
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::pair<double, Interval>>> points;

  void add(const std::string& name, double value, const Interval& mse) {
    if (std::isnan(mse.value)) return;
    if (points.count(name) == 0) names.push_back(name);
    points[name].emplace_back(value, mse);
    values.push_back(value);
  }
};

// Returns the keys whose values are all numbers, in the order in which they occur. The size of a
// seed means nothing.
std::vector<std::string> numberKeys(const std::vector<const Values*>& all) {
  std::vector<std::string> keys;
  std::set<std::string> others = {"seed"};
  for (const Values* values : all) {
    for (const SweptValue& value : *values) {
      if (!numberOf(value)) others.insert(value.key);
      if (std::find(keys.begin(), keys.end(), value.key) == keys.end()) keys.push_back(value.key);
    }
  }
  std::erase_if(keys, [&](const std::string& key) { return others.count(key) > 0; });
  return keys;
}

// Takes the value of the key out of the list, if it is there.
std::optional<double> take(Values& values, const std::string& key) {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const SweptValue& value) { return value.key == key; });
  if (found == values.end()) return std::nullopt;
  const std::optional<double> number = numberOf(*found);
  values.erase(found);
  return number;
}

std::string withValues(const std::string& name, const Values& values) {
  return values.empty() ? name : fmt::format("{}, {}", name, sweepLabel(values));
}

// Returns a plot of at least two values; null if there are fewer.
Json plotOf(const std::string& key, const SweptLines& lines) {
  const std::set<double> distinct(lines.values.begin(), lines.values.end());
  if (distinct.size() < 2) return nullptr;
  const SweptAxis axis = sweptAxis(lines.values, kSweptFarApart);
  const std::string unit = unitOfKey(key);
  Json series = Json::array();
  for (const std::string& name : lines.names) {
    std::vector<std::pair<double, Interval>> points = lines.points.at(name);
    std::stable_sort(points.begin(), points.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Json list = Json::array();
    for (const auto& [value, mse] : points)
      list.push_back(
          {axis.at(value), finiteJson(mse.value), finiteJson(mse.lo), finiteJson(mse.hi)});
    series.push_back({{"name", name}, {"points", std::move(list)}});
  }
  return {{"id", plainId(safeFileName("swept-" + key))},
          {"title", "MSE over " + key},
          {"x", axis.document(unit.empty() ? key : key + ", " + unit)},
          {"y", {{"title", "MSE"}, {"log", true}}},
          {"intervals", "bars"},
          {"series", std::move(series)}};
}

// Returns what the blocks of one scene and component have in common, as a name of a file.
std::string labelOf(const SweptBlock& block) {
  const BlockResult& result = *block.rows->front().block;
  return fmt::format("swept-{}-{}", result.scene, componentName(result.component));
}

// Returns "Values of max_bounces: 1, 2, 4. Values of filter: box, center."
std::string sweptValuesText(const std::vector<const Values*>& all) {
  std::vector<std::pair<std::string, std::vector<std::string>>> keys;
  for (const Values* values : all) {
    for (const SweptValue& value : *values) {
      auto key = std::find_if(keys.begin(), keys.end(),
                              [&](const auto& other) { return other.first == value.key; });
      if (key == keys.end()) key = keys.insert(keys.end(), {value.key, {}});
      std::vector<std::string>& texts = key->second;
      if (std::find(texts.begin(), texts.end(), value.text) == texts.end())
        texts.push_back(value.text);
    }
  }
  std::string text;
  for (const auto& [key, texts] : keys)
    text +=
        fmt::format("{}Values of {}: {}.", text.empty() ? "" : " ", key, fmt::join(texts, ", "));
  return text;
}

Json documentOf(const std::vector<const SweptBlock*>& points, const std::string& label) {
  std::vector<const Values*> values;
  for (const SweptBlock* point : points) values.push_back(&point->suite->swept);
  Json plots = Json::array(), rows = Json::array();
  std::vector<std::string> keys;
  for (const std::string& key : numberKeys(values)) {
    SweptLines lines;
    for (const SweptBlock* point : points) {
      Values others = point->suite->swept;
      const std::optional<double> value = take(others, key);
      for (const MethodSummary& row : *point->rows)
        if (value) lines.add(withValues(row.method->name, others), *value, row.mse);
    }
    Json plot = plotOf(key, lines);
    if (plot.is_null()) continue;
    plots.push_back(std::move(plot));
    keys.push_back(key);
  }
  if (plots.empty()) return nullptr;
  // Rows without columns: methods look as they do in the blocks of the points.
  for (const MethodSummary& row : *points.front()->rows)
    rows.push_back({{"method", row.method->name}, {"cells", Json::object()}});
  const BlockResult& block = *points.front()->rows->front().block;
  return {{"id", plainId(safeFileName(label))},
          {"title", fmt::format("{} of {}, {} light", fmt::join(keys, " and "), block.scene,
                                componentName(block.component))},
          {"subtitle", sweptValuesText(values)},
          {"columns", Json::array()},
          {"rows", std::move(rows)},
          {"plots", std::move(plots)}};
}

}  // namespace

Json methodSweepPlots(const std::vector<MethodSummary>& rows) {
  std::vector<const Values*> values;
  for (const MethodSummary& row : rows) values.push_back(&row.method->swept);
  Json plots = Json::array();
  for (const std::string& key : numberKeys(values)) {
    SweptLines lines;
    for (const MethodSummary& row : rows) {
      const SuiteMethod& method = *row.method;
      Values others = method.swept;
      const std::optional<double> value = take(others, key);
      // The name of a method on several backends ends in its backend.
      const std::string backend =
          method.name.substr(std::min(method.base.size(), method.name.size()));
      if (value) lines.add(withValues(method.given, others) + backend, *value, row.mse);
    }
    Json plot = plotOf(key, lines);
    if (!plot.is_null()) plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<SettingSweep> settingSweeps(const std::vector<SweptBlock>& blocks) {
  std::vector<std::string> labels;
  std::map<std::string, std::vector<size_t>> byLabel;
  for (size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].rows->empty()) continue;
    const std::string label = labelOf(blocks[b]);
    if (byLabel.count(label) == 0) labels.push_back(label);
    byLabel[label].push_back(b);
  }
  std::vector<SettingSweep> sweeps;
  for (const std::string& label : labels) {
    std::vector<const SweptBlock*> points;
    for (const size_t block : byLabel[label]) points.push_back(&blocks[block]);
    Json document = documentOf(points, label);
    if (!document.is_null()) sweeps.push_back({std::move(document), byLabel[label]});
  }
  return sweeps;
}

}  // namespace restlab
