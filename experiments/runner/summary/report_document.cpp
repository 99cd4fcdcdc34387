#include "experiments/runner/summary/report_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/image/metrics/metrics.h"
#include "core/frame/method_settings.h"
#include "experiments/report/text.h"
#include "experiments/runner/run/build_info.h"
#include "experiments/runner/summary/figures.h"
#include "experiments/runner/run/files.h"
#include "experiments/runner/run/prepare.h"
#include "experiments/runner/summary/report.h"
#include "experiments/runner/run/run_record.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Column of the report. In titles and helps, {0} is the baseline's name and {1} the average's.
struct Column {
  const char *key, *title, *unit, *better, *help;
  Interval (*value)(const MethodSummary&);
  std::string (*note)(const MethodSummary&) = nullptr;
};

Interval only(double value) { return {value, kUnknown, kUnknown}; }
const Interval kNone{kUnknown, kUnknown, kUnknown};

Interval slopeOf(const MethodSummary& row) {
  return row.convergence ? row.convergence->slope : kNone;
}
Interval equalTimeOf(const MethodSummary& row) {
  return row.speedUp ? row.speedUp->equalTime.ratio : kNone;
}
Interval equalErrorOf(const MethodSummary& row) {
  return row.speedUp ? row.speedUp->equalError.ratio : kNone;
}
Interval varianceOf(const MethodSummary& row) {
  return row.temporal ? row.temporal->variance : kNone;
}
Interval differenceOf(const MethodSummary& row) {
  return row.temporal ? row.temporal->difference : kNone;
}
Interval errorDifferenceOf(const MethodSummary& row) {
  return row.temporal ? row.temporal->errorDifferenceSquared : kNone;
}
Interval correlationOf(const MethodSummary& row) {
  return row.temporal ? row.temporal->autocorrelation[0] : kNone;
}

// Columns that are unknown in every row are left out of the report.
const std::vector<Column>& columns() {
  static const std::vector<Column> all = {
      {"time_ms", "time per frame", "ms", "lower", "median over timed frames: passes, nothing else",
       [](const MethodSummary& row) { return only(row.timeMsMedian); }},
      {"time_ratio", "time / time of {0}", "", "lower",
       "geometric mean over runs of the median over frames of time / time of the frame of {0} "
       "beside it; the ratio of two medians may differ where the machine was disturbed",
       [](const MethodSummary& row) { return row.timeRatio; }},
      {"mse", "MSE", "", "lower", "of the frame after the warm-up, against the reference's halves",
       [](const MethodSummary& row) { return errorOf(row.mse); }},
      {"mse_ratio", "MSE of {0} / MSE", "", "higher", "above 1: a lower MSE than {0}",
       [](const MethodSummary& row) { return row.mseRatio; }},
      {"average_ratio", "MSE of {1} / MSE", "", "higher", "above 1: a lower MSE than {1}",
       [](const MethodSummary& row) { return row.ratioToAverage; }},
      {"efficiency", "efficiency against {0}", "", "higher",
       "MSE of {0} / MSE, divided by the time ratio to {0}",
       [](const MethodSummary& row) { return row.efficiencyRatio; }},
      {"energy", "energy", "", "none", "mean(image) / mean(reference); its ideal is 1",
       [](const MethodSummary& row) { return row.energyRatio; }},
      {"bias_share", "bias^2 / MSE", "%", "none", "signed; over all pairs of runs",
       [](const MethodSummary& row) { return percent(row.biasShare); }},
      {"variance", "variance", "", "lower", "MSE less bias^2: mean over pixels, from pairs of runs",
       [](const MethodSummary& row) { return row.variance; }},
      {"worst_share", "worst 0.1 %", "%", "none",
       "share of the MSE in the worst thousandth of the pixels",
       [](const MethodSummary& row) { return only(100.0 * row.worstShare); }},
      {"mse_without_lights", "MSE without lights in view", "", "lower",
       "over the pixels that show no light directly",
       [](const MethodSummary& row) { return errorOf(row.mseWithoutLights); }},
      {"relmse", "relMSE", "", "lower", "relmse_e1e-2",
       [](const MethodSummary& row) { return errorOf(row.relmse); }},
      {"relmse_trimmed", "relMSE without the worst 0.1 %", "", "lower", "relmse_e1e-2_trim0.1",
       [](const MethodSummary& row) { return errorOf(row.relmseTrimmed); }},
      {"slope", "slope", "", "lower", "of log(MSE) over log(time) while frames accumulate",
       slopeOf},
      {"equal_time", "MSE of {0} / MSE at equal time", "", "higher",
       "MSE of {0} / MSE off the fitted lines, where both have taken the same time", equalTimeOf,
       [](const MethodSummary& row) {
         return row.speedUp ? fmt::format("at {} ms", shortNumber(row.speedUp->equalTime.at)) : "";
       }},
      {"equal_error", "time of {0} / time to equal error", "", "higher",
       "off the fitted lines; above 1: faster", equalErrorOf,
       [](const MethodSummary& row) {
         return row.speedUp ? "to " + shortNumber(row.speedUp->equalError.at) : "";
       }},
      {"temporal_variance", "variance over frames", "", "lower", "flicker of a pixel", varianceOf},
      {"temporal_difference", "frame difference", "", "none",
       "mean |f_t - f_(t-1)|, motion included", differenceOf},
      {"temporal_error_difference", "change of errors", "", "lower",
       "mean (e_t - e_(t-1))^2 of the errors against the reference's halves: without motion and "
       "without the reference's noise",
       errorDifferenceOf},
      {"correlation", "correlation of errors", "", "lower", "of frames side by side",
       correlationOf},
      {"rays", "rays / pixel", "", "none", "path and shadow rays of a frame",
       [](const MethodSummary& row) {
         return only(row.raysPathPerPixel + row.raysShadowPerPixel);
       }},
      {"bytes", "bytes / pixel", "", "lower", "of all buffers", [](const MethodSummary& row) {
         return only(row.method->images ? kUnknown : double(row.result->bytesPerPixel));
       }}};
  return all;
}

// Keeps only the main figures in the first table, so that it fits into a window.
bool isDetail(const std::string& key) {
  static const std::set<std::string> first = {"time_ms",   "time_ratio",    "mse",
                                              "mse_ratio", "average_ratio", "energy"};
  return first.count(key) == 0;
}

Json cellOf(const Interval& interval) {
  Json cell = {{"value", finiteJson(interval.value)}};
  if (!std::isnan(interval.lo)) cell["lo"] = finiteJson(interval.lo);
  if (!std::isnan(interval.hi)) cell["hi"] = finiteJson(interval.hi);
  return cell;
}

// Returns whether a value may be ranked: errors below the reference's noise and times of other
// programs may not.
bool isRanked(const Column& column, const MethodSummary& row, double value) {
  const std::string key = column.key;
  const bool isTime = key == "time_ms" || key == "time_ratio" || key == "efficiency";
  if (isTime) return !row.method->images;
  const bool isError = key == "mse" || key == "mse_without_lights" || key == "relmse_trimmed" ||
                       key == "relmse" || key == "variance";
  return !isError || value > 0.0;
}

Json cellOf(const Column& column, const MethodSummary& row, const Interval& value) {
  Json cell = cellOf(value);
  const std::string note = column.note && !std::isnan(value.value) ? column.note(row) : "";
  if (!note.empty()) cell["note"] = note;
  if (!isRanked(column, row, value.value)) cell["ranked"] = false;
  return cell;
}

void addTable(const std::vector<MethodSummary>& rows, Json& block) {
  const Suite& suite = *rows.front().suite;
  const std::string baseline = suite.baselineName(), average = suite.averageName();
  const auto named = [&](const char* text) {
    return fmt::format(fmt::runtime(text), baseline, average);
  };
  Json heads = Json::array(), lines = Json::array();
  for (const MethodSummary& row : rows) {
    lines.push_back({{"method", row.method->name},
                     {"counts", row.counts},
                     {"flags", row.flags},
                     {"cells", Json::object()}});
  }
  for (const Column& column : columns()) {
    bool isKnown = false;
    for (const MethodSummary& row : rows) isKnown = isKnown || !std::isnan(column.value(row).value);
    if (!isKnown) continue;
    heads.push_back({{"key", column.key},
                     {"title", named(column.title)},
                     {"unit", column.unit},
                     {"better", column.better},
                     {"detail", isDetail(column.key)},
                     {"digits", column.key == std::string("energy") ? kEnergyDigits : kDigits},
                     {"help", named(column.help)}});
    for (size_t i = 0; i < rows.size(); ++i) {
      // Write NaN only for images with NaN; unknown values stay empty cells.
      const Interval value = column.value(rows[i]);
      if (!std::isnan(value.value) || rows[i].nonfinite > 0)
        lines[i]["cells"][column.key] = cellOf(column, rows[i], value);
    }
  }
  for (size_t f = 0; f < rows.front().figures.size(); ++f) {
    const FigureInfo figure = figureInfos(*rows.front().suite).at(f);
    const MetricInfo& metric = findMetric(figure.metric);
    const bool hasIdeal = figure.metric == "energy_ratio";
    const std::string better = hasIdeal ? "none" : metric.higherIsBetter ? "higher" : "lower";
    heads.push_back({{"key", figure.name},
                     {"title", figure.name},
                     {"unit", ""},
                     {"better", better},
                     {"detail", true},
                     {"digits", digitsOf(figure)},
                     {"help", metric.formula}});
    for (size_t i = 0; i < rows.size(); ++i)
      lines[i]["cells"][figure.name] = cellOf(rows[i].figures[f].second);
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
           "camera {}{}{}, {}x{}, {} scattering events, Russian roulette {}, filter {}{}; {} "
           "of {} warm-up and {} timed frames; reference {}{}",
           block.camera,
           suite.hasMovingCamera() ? fmt::format(", path {}", suite.cameraPathName) : "",
           suite.events.empty() ? "" : ", lights: " + eventsText(suite.events, suite.warmupFrames),
           block.width, block.height, suite.maxBounces, suite.russianRoulette ? "on" : "off",
           filterName(suite.pixelFilter),
           suite.multiscatter ? ", multiple scattering compensated" : "",
           counted(rows.front().runs, "run"), suite.warmupFrames, suite.timedFrames,
           originOf(block.reference),
           block.reference.half0 ? "" : ", without halves: its own noise is part of every MSE")}};
  addTable(rows, document);
  Json plots = Json::array();
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
  if (suite.timing) plots.push_back(singleFrames(rows));
  const bool isStill = !suite.hasMovingCamera();
  if (rows.front().temporal && isStill) plots.push_back(correlations(rows));
  // Name the reference in each plot, which may be used outside the report.
  for (Json& plot : plots) {
    plot["x"]["note"] = "reference: " + originOf(block.reference);
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
