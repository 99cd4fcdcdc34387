#include "experiments/runner/tables/report_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/frame/method_settings.h"
#include "core/frame/session.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/base/json_number.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/tables/columns.h"
#include "experiments/runner/tables/parameter_sweep.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Columns that the report shows first, in this order; further ones follow in that of columnsOf().
const std::vector<std::string>& firstColumns() {
  static const std::vector<std::string> keys = {
      "time_ms_median",
      "time_ratio",
      "mse",
      "mse_ratio",
      "average_mse_ratio",
      "efficiency_ratio",
      "energy_ratio",
      "bias_share_of_mse",
      "variance",
      "worst_0.1pct_share_of_mse",
      "mse_without_lights",
      "relmse_e1e-2",
      "relmse_e1e-2_trim0.1",
      "accumulated_slope",
      "equal_time_mse_ratio",
      "equal_error_time_ratio",
      "temporal_variance",
      "temporal_difference",
      "temporal_error_difference_squared",
      "error_autocorrelation_1",
      "rays_per_pixel",
      "bytes_per_pixel",
  };
  return keys;
}

Json cellOf(const Interval& interval) {
  Json cell = {{"value", finiteJson(interval.value)}};
  if (!std::isnan(interval.lo)) cell["lo"] = finiteJson(interval.lo);
  if (!std::isnan(interval.hi)) cell["hi"] = finiteJson(interval.hi);
  return cell;
}

Json cellOf(const Columns& columns, const Column& column, const MethodSummary& row) {
  const Interval number = numberOf(column, row);
  Json cell = cellOf(number);
  if (!column.noteKey.empty() && !std::isnan(number.value)) {
    const Column& place = columnAt(columns, column.noteKey);
    cell["note"] = fmt::format("{} {}{}", column.noteWord, shortNumber(numberOf(place, row).value),
                               place.unit.empty() ? "" : " " + place.unit);
  }
  if (!isRanked(column, row)) cell["ranked"] = false;
  return cell;
}

// Adds the columns that have a title, but those that are unknown in every row.
void addTable(const std::vector<MethodSummary>& rows, Json& block) {
  Json heads = Json::array(), lines = Json::array();
  for (const MethodSummary& row : rows) {
    std::vector<std::string> notes;
    const auto isDoubt = [&](const std::string& flag) {
      return std::find(row.doubts.begin(), row.doubts.end(), flag) != row.doubts.end();
    };
    std::remove_copy_if(row.flags.begin(), row.flags.end(), std::back_inserter(notes), isDoubt);
    lines.push_back({{"method", row.method->name},
                     {"counts", row.counts},
                     {"warnings", row.doubts},
                     {"flags", notes},
                     {"cells", Json::object()}});
  }
  const Columns columns = columnsOf(rows);
  for (const Column* column : withFirst(columns, firstColumns())) {
    if (column->title.empty() || !isKnown(*column, rows)) continue;
    const std::string key = column->reportKey.empty() ? column->key : column->reportKey;
    heads.push_back({{"key", key},
                     {"title", column->title},
                     {"unit", column->unit},
                     {"better", column->better},
                     {"detail", !column->isMain},
                     {"digits", column->digits},
                     {"help", column->help}});
    for (size_t i = 0; i < rows.size(); ++i) {
      // Write NaN only for images with NaN; unknown values stay empty cells.
      if (!std::isnan(numberOf(*column, rows[i]).value) || rows[i].nonfinite > 0)
        lines[i]["cells"][key] = cellOf(columns, *column, rows[i]);
    }
  }
  block["columns"] = std::move(heads);
  block["rows"] = std::move(lines);
}

// Plots MSE of accumulated frames over `x` of a point.
Json curves(const std::vector<MethodSummary>& rows, const char* id, const char* title,
            const char* xTitle, double (*x)(const ConvergencePoint&), bool isFitted) {
  Json series = Json::array();
  for (const MethodSummary& row : rows) {
    if (!row.convergence) continue;
    Json points = Json::array(), hollow = Json::array();
    for (const ConvergencePoint& point : row.convergence->points) {
      if (isFitted && !point.isFitted) hollow.push_back(points.size());
      points.push_back({finiteJson(x(point)), finiteJson(point.mse.value), finiteJson(point.mse.lo),
                        finiteJson(point.mse.hi)});
    }
    Json one = {{"name", row.method->name}, {"points", std::move(points)}};
    if (!hollow.empty()) one["hollow"] = std::move(hollow);
    const Interval& slope = row.convergence->slope;
    if (isFitted && !std::isnan(slope.value)) {
      one["fit"] = {{"slope", slope.value},
                    {"lo", finiteJson(slope.lo)},
                    {"hi", finiteJson(slope.hi)},
                    {"intercept", row.convergence->intercept / std::numbers::ln10}};
    }
    series.push_back(std::move(one));
  }
  return {{"id", id},
          {"title", title},
          {"x", {{"title", xTitle}, {"log", true}}},
          {"y", {{"title", "MSE"}, {"log", true}}},
          {"series", std::move(series)}};
}

// Plots the error of a single frame over its time, as a viewer sees it.
Json singleFrames(const std::vector<MethodSummary>& rows) {
  Json series = Json::array();
  for (const MethodSummary& row : rows) {
    if (std::isnan(row.timeMsMedian)) continue;
    series.push_back({{"name", row.method->name},
                      {"points",
                       {{finiteJson(row.timeMsMedian), finiteJson(row.mse.value),
                         finiteJson(row.mse.lo), finiteJson(row.mse.hi)}}}});
  }
  return {{"id", "single-frame"},
          {"title", "MSE of a single frame over its time"},
          {"x", {{"title", "time per frame, ms"}, {"log", true}}},
          {"y", {{"title", "MSE"}, {"log", true}}},
          {"series", std::move(series)}};
}

// Plots a figure of single frames over the age of the history. Leaves out unknown values.
Json agePlot(const std::vector<MethodSummary>& rows, const char* id, const std::string& title,
             const std::string& yTitle, Interval (*value)(const AgeSummary&)) {
  Json series = Json::array();
  for (const MethodSummary& row : rows) {
    Json points = Json::array();
    for (const AgeSummary& age : row.ages) {
      const Interval of = value(age);
      if (std::isnan(of.value)) continue;
      points.push_back(
          {double(age.age), finiteJson(of.value), finiteJson(of.lo), finiteJson(of.hi)});
    }
    if (!points.empty()) series.push_back({{"name", row.method->name}, {"points", points}});
  }
  return {{"id", id},
          {"title", title},
          {"x", {{"title", "frames since the view stands still"}, {"log", true}}},
          {"y", {{"title", yTitle}, {"log", true}}},
          {"series", std::move(series)}};
}

void addAgePlots(const std::vector<MethodSummary>& rows, Json& plots) {
  if (rows.front().ages.empty()) return;
  plots.push_back(agePlot(rows, "age", "MSE of a single frame over the age of the history", "MSE",
                          [](const AgeSummary& age) { return age.mse; }));
  const Suite& suite = *rows.front().suite;
  const std::string baseline = suite.baselineName(), averaged = suite.averageName();
  Json ratio = agePlot(rows, "age-path", fmt::format("times lower than {}, by age", baseline),
                       fmt::format("MSE of {} / MSE", baseline),
                       [](const AgeSummary& age) { return age.mseRatio; });
  if (!ratio["series"].empty()) plots.push_back(std::move(ratio));
  Json average = agePlot(rows, "age-average", fmt::format("times lower than {}, by age", averaged),
                         fmt::format("MSE of {} / MSE", averaged),
                         [](const AgeSummary& age) { return age.ratioToAverage; });
  if (!average["series"].empty()) plots.push_back(std::move(average));
}

// How far iterated solutions were from the next one.
void addResiduals(const std::vector<MethodSummary>& rows, Json& plots) {
  Json series = Json::array();
  for (const MethodSummary& row : rows) {
    Json points = Json::array();
    for (size_t i = 0; i < row.residuals.size(); ++i) {
      const double value = row.residuals[i];
      if (value > 0.0) points.push_back({double(i + 1), value, value, value});
    }
    if (!points.empty()) series.push_back({{"name", row.method->name}, {"points", points}});
  }
  if (series.empty()) return;
  plots.push_back(
      {{"id", "residual"},
       {"title", "residual by iteration"},
       {"x", {{"title", "iterations"}, {"log", true}}},
       {"y", {{"title", "light that is missing / light of the sources"}, {"log", true}}},
       {"series", std::move(series)}});
}

Json correlations(const std::vector<MethodSummary>& rows) {
  Json series = Json::array();
  for (const MethodSummary& row : rows) {
    if (!row.temporal) continue;
    Json points = Json::array();
    for (size_t lag = 1; lag <= row.temporal->autocorrelation.size(); ++lag) {
      const Interval& of = row.temporal->autocorrelation[lag - 1];
      points.push_back({double(lag), finiteJson(of.value), finiteJson(of.lo), finiteJson(of.hi)});
    }
    series.push_back({{"name", row.method->name}, {"points", std::move(points)}});
  }
  return {{"id", "correlation"},
          {"title", "correlation of errors over frames"},
          {"x", {{"title", "frames between"}, {"log", false}}},
          {"y", {{"title", "correlation"}, {"log", false}}},
          {"series", std::move(series)}};
}

Json barsOf(const std::vector<MethodSummary>& rows) {
  Json bars = Json::array();
  for (const MethodSummary& row : rows) {
    if (row.passes.empty()) continue;
    Json parts = Json::array();
    for (const PassTiming& pass : row.passes) parts.push_back({pass.name, pass.timeMs});
    bars.push_back({{"name", row.method->name}, {"parts", std::move(parts)}});
  }
  return {{"title", "time of the passes"}, {"unit", "ms"}, {"rows", std::move(bars)}};
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  for (size_t at = 0; at <= list.size();) {
    const size_t plus = std::min(list.find('+', at), list.size());
    parts.push_back(list.substr(at, plus - at));
    at = plus + 1;
  }
  return parts;
}

Json healthOf(const std::vector<MethodSummary>& rows) {
  Json heads = Json::array(), lines = Json::array();
  for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i) {
    const char* name = Health::names()[i];
    if (!name || !*name) continue;
    heads.push_back({{"name", name}, {"bad", isFault(i)}});
  }
  for (const MethodSummary& row : rows) {
    if (row.method->images) continue;
    Json counts = Json::array();
    for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i) {
      const char* name = Health::names()[i];
      if (name && *name) counts.push_back(row.health.health.counts[i]);
    }
    lines.push_back({{"method", row.method->name}, {"counts", std::move(counts)}});
  }
  return {{"columns", std::move(heads)}, {"rows", std::move(lines)}};
}

Json settingsOf(const std::vector<MethodSummary>& rows) {
  Json settings = Json::array();
  for (const MethodSummary& row : rows) {
    if (row.method->images) continue;
    const SessionConfig& config = row.method->session;
    std::string text;
    for (const auto& [key, value] : settingValues(config))
      if (!value.empty()) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, value);
    for (const auto& [key, value] : config.parameters)
      text += fmt::format(", {} = {}", key, parameterText(value));
    settings.push_back({{"method", row.method->name}, {"text", std::move(text)}});
  }
  return settings;
}

// Returns the row of the lowest error among those whose numbers are to be trusted, the first of
// equal ones; null if there is none.
const MethodSummary* bestOf(const std::vector<MethodSummary>& rows) {
  const MethodSummary* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const MethodSummary& row : rows) {
    if (!row.counts || !row.doubts.empty()) continue;
    // Errors below the noise of the reference are equal.
    const double error = std::max(row.mse.value, 0.0);
    if (!(error < least)) continue;
    least = error;
    best = &row;
  }
  return best;
}

}  // namespace

Json blockDocument(const Suite& suite, const std::vector<MethodSummary>& rows, float exposure) {
  const BlockResult& block = *rows.front().block;
  const std::string label = blockLabel(suite, block);
  Json document = {
      {"id", plainId(label)},
      {"title", fmt::format("{}, {} light{}", block.scene, componentName(block.component),
                            suite.point.empty() ? "" : ", " + suite.point)},
      {"subtitle",
       fmt::format(
           "camera {}{}{}, {}x{}, {}; {} "
           "of {} warm-up and {} timed frames; reference {}{}",
           block.camera,
           suite.hasMovingCamera() ? fmt::format(", path {}", suite.cameraPathName) : "",
           suite.events.empty() ? "" : ", lights: " + eventsText(suite.events, suite.warmupFrames),
           block.width, block.height, transportLine(suite), counted(rows.front().runs, "run"),
           suite.warmupFrames, suite.timedFrames, originOf(block.reference),
           block.reference.half0 ? "" : ", without halves: its own noise is part of every MSE")}};
  addTable(rows, document);
  Json plots = methodSweepPlots(rows);
  if (rows.front().convergence) {
    if (suite.timing) {
      plots.push_back(curves(
          rows, "error-time", "MSE of accumulated frames over time", "time, ms",
          [](const ConvergencePoint& point) { return point.timeMs; }, true));
    }
    plots.push_back(curves(
        rows, "error-frames", "MSE of accumulated frames over their number", "frames",
        [](const ConvergencePoint& point) { return double(point.frames); }, false));
  }
  addAgePlots(rows, plots);
  addResiduals(rows, plots);
  if (suite.timing) plots.push_back(singleFrames(rows));
  const bool isStill = !suite.hasMovingCamera();
  if (rows.front().temporal && isStill) plots.push_back(correlations(rows));
  // Name the reference in each plot, which may be used outside the report.
  for (Json& plot : plots) {
    const std::string own = plot["x"].value("note", "");
    plot["x"]["note"] = own + (own.empty() ? "" : "; ") + "reference: " + originOf(block.reference);
  }
  document["plots"] = std::move(plots);
  if (suite.timing) document["bars"] = barsOf(rows);
  Json left = Json::array(), images = Json::array();
  images.push_back({{"name", "reference"},
                    {"file", fmt::format("images/{}-reference.exr", label)},
                    {"role", "reference"}});
  for (const MethodSummary& row : rows) {
    if (!row.method->images) {
      left.push_back(
          {{"method", row.method->name}, {"features", split(row.result->featuresLeftOut)}});
    }
    images.push_back(
        {{"name", row.method->name},
         {"file", fmt::format("images/{}-{}.exr", label, safeFileName(row.method->name))},
         {"role", "method"}});
  }
  document["settings"] = settingsOf(rows);
  document["left_out"] = std::move(left);
  document["health"] = healthOf(rows);
  document["images"] = std::move(images);
  if (const MethodSummary* best = bestOf(rows)) document["opens_on"] = best->method->name;
  document["exposure"] = exposure;
  return document;
}

// Returns warnings about the whole report.
Json warningsOf(const Suite& suite, const Json& record) {
  Json warnings = Json::array();
  const std::string status = record.at("status").get<std::string>();
  if (status != "finished") {
    warnings.push_back(
        fmt::format("Not finished ({}): what follows is of the runs that were.", status));
  }
  const double busy = record.value("busy_at_start", 0.0);
  if (suite.timing && busy > 0.2) {
    warnings.push_back(fmt::format(
        "Other programs took {:.0f} % of the machine when the suite began: times may be too long.",
        100.0 * busy));
  }
  return warnings;
}

Json reportDocument(const Suite& suite, const Json& record, std::vector<Json> blocks,
                    const std::vector<std::string>& notes) {
  Json provenance = Json::array();
  const auto add = [&](const std::string& prefix, const Json& object) {
    for (const auto& [key, value] : object.items()) {
      provenance.push_back(
          {prefix + key, value.is_string() ? value.get<std::string>() : value.dump()});
    }
  };
  add("", {{"suite file", record.at("file")},
           {"started", record.at("started")},
           {"written", record.at("written")},
           {"status", record.at("status")},
           {"results schema", record.at("schema")}});
  add("build ", record.at("build"));
  add("machine ", record.at("machine"));
  for (const Json& device : record.at("devices")) provenance.push_back({"device", device.dump()});
  provenance.push_back({"peak resident MiB", record.at("peak_resident_mib").dump()});
  return {{"schema", 1},
          {"title", suite.name},
          {"question", suite.question},
          {"generated", record.at("written")},
          {"command", shellCommand(record.at("argv").get<std::vector<std::string>>())},
          {"warnings", warningsOf(suite, record)},
          {"notes", notes},
          {"provenance", std::move(provenance)},
          {"blocks", std::move(blocks)}};
}

}  // namespace restlab
