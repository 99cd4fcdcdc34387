// summary.csv: first the columns that scripts depend on, in a fixed order, then further ones.
#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/summary/report.h"

namespace restlab {

namespace {

std::string number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return fmt::format("{:.9g}", value);
}

// RFC 4180: quotes text with a comma or quote; line breaks become blanks.
std::string quoted(const std::string& value) {
  const std::string text = oneLine(value);
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

struct Column {
  std::string name;
  std::string value;
};

std::vector<Column> contractColumns(const Suite& suite, const MethodSummary& row) {
  std::vector<Column> columns = {{"scene", row.block->scene}, {"camera", row.block->camera}};
  for (const auto& [key, value] : settingValues(row.method->session))
    columns.push_back({key, value});
  const std::vector<Column> figures = {{"width", std::to_string(row.block->width)},
                                       {"height", std::to_string(row.block->height)},
                                       {"frames", std::to_string(suite.timedFrames)},
                                       {"runs", std::to_string(row.runs)},
                                       {"time_ms_median", number(row.timeMsMedian)},
                                       {"time_ms_p95", number(row.timeMsP95)},
                                       {"mse", number(row.mse.value)},
                                       {"mse_ci_lo", number(row.mse.lo)},
                                       {"mse_ci_hi", number(row.mse.hi)},
                                       {"relmse_e1e-2", number(row.relmse.value)},
                                       {"energy_ratio", number(row.energyRatio.value)},
                                       {"nonfinite", std::to_string(row.nonfinite)},
                                       {"mse_ratio", number(row.mseRatio.value)},
                                       {"time_ratio", number(row.timeRatio.value)},
                                       {"efficiency_ratio", number(row.efficiencyRatio.value)},
                                       {"features_left_out", row.result->featuresLeftOut}};
  columns.insert(columns.end(), figures.begin(), figures.end());
  return columns;
}

// Returns "confidence_cap=20 temporal=true": all parameters, defaults included.
std::string parametersText(const SuiteMethod& method) {
  std::string text;
  for (const auto& [key, value] : method.parameters())
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, parameterText(value));
  return text;
}

// Returns the method that the row's ratios are relative to; "" if there is none.
std::string nameAt(const Suite& suite, size_t (Suite::*of)(size_t) const,
                   const MethodSummary& row) {
  const size_t found = (suite.*of)(size_t(row.method - suite.methods.data()));
  return found < suite.methods.size() ? suite.methods[found].name : "";
}

std::vector<Column> furtherColumns(const Suite& suite, const MethodSummary& row) {
  std::string flags, passes;
  for (const std::string& flag : row.flags) {
    flags += flags.empty() ? "" : "; ";
    flags += flag;
  }
  for (const PassTiming& pass : row.passes) {
    passes += fmt::format("{}{}={:.4g}", passes.empty() ? "" : " ", pass.name, pass.timeMs);
  }
  std::vector<Column> columns = {
      {"component", componentName(row.block->component)},
      {"method", row.method->name},
      {"bias_class", biasName(row.bias)},
      {"counts", row.counts ? "1" : "0"},
      {"flags", flags},
      {"mse_ratio_ci_lo", number(row.mseRatio.lo)},
      {"mse_ratio_ci_hi", number(row.mseRatio.hi)},
      {"average_mse_ratio", number(row.ratioToAverage.value)},
      {"average_mse_ratio_ci_lo", number(row.ratioToAverage.lo)},
      {"average_mse_ratio_ci_hi", number(row.ratioToAverage.hi)},
      {"time_ratio_ci_lo", number(row.timeRatio.lo)},
      {"time_ratio_ci_hi", number(row.timeRatio.hi)},
      {"time_ratio_of_medians", number(row.timeRatioOfMedians)},
      {"efficiency_ratio_ci_lo", number(row.efficiencyRatio.lo)},
      {"efficiency_ratio_ci_hi", number(row.efficiencyRatio.hi)},
      {"energy_ratio_ci_lo", number(row.energyRatio.lo)},
      {"energy_ratio_ci_hi", number(row.energyRatio.hi)},
      {"relmse_e1e-2_ci_lo", number(row.relmse.lo)},
      {"relmse_e1e-2_ci_hi", number(row.relmse.hi)},
      {"relmse_e1e-2_trim0.1", number(row.relmseTrimmed.value)},
      {"relmse_e1e-2_trim0.1_ci_lo", number(row.relmseTrimmed.lo)},
      {"relmse_e1e-2_trim0.1_ci_hi", number(row.relmseTrimmed.hi)},
      {"relmse_e1e-2_trim0.1_ratio", number(row.relmseTrimmedRatio.value)},
      {"relmse_e1e-2_trim0.1_ratio_ci_lo", number(row.relmseTrimmedRatio.lo)},
      {"relmse_e1e-2_trim0.1_ratio_ci_hi", number(row.relmseTrimmedRatio.hi)},
      {"mse_without_lights", number(row.mseWithoutLights.value)},
      {"mse_without_lights_ci_lo", number(row.mseWithoutLights.lo)},
      {"mse_without_lights_ci_hi", number(row.mseWithoutLights.hi)},
      {"mse_ratio_without_lights", number(row.mseRatioWithoutLights.value)},
      {"mse_ratio_without_lights_ci_lo", number(row.mseRatioWithoutLights.lo)},
      {"mse_ratio_without_lights_ci_hi", number(row.mseRatioWithoutLights.hi)},
      {"bias_squared", number(row.biasSquared.value)},
      {"bias_squared_ci_lo", number(row.biasSquared.lo)},
      {"bias_squared_ci_hi", number(row.biasSquared.hi)},
      {"bias_share_of_mse", number(row.biasShare.value)},
      {"variance", number(row.variance.value)},
      {"variance_ci_lo", number(row.variance.lo)},
      {"variance_ci_hi", number(row.variance.hi)},
      {"worst_0.1pct_share_of_mse", number(row.worstShare)},
      {"rays_per_pixel", number(row.raysPathPerPixel + row.raysShadowPerPixel)},
      {"path_rays_per_pixel", number(row.raysPathPerPixel)},
      {"shadow_rays_per_pixel", number(row.raysShadowPerPixel)},
      {"bytes_per_pixel", std::to_string(row.result->bytesPerPixel)},
      {"passes_ms_median", passes},
      {"max_bounces", std::to_string(suite.maxBounces)},
      {"warmup_frames", std::to_string(suite.warmupFrames)},
      {"russian_roulette", suite.russianRoulette ? "on" : "off"},
      {"filter", filterName(suite.pixelFilter)},
      {"multiscatter", suite.multiscatter ? "on" : "off"},
      {"seed", std::to_string(suite.seed)},
      {"kernel", row.method->images               ? "none"
                 : row.method->session.specialise ? "specialised"
                                                  : "general"},
      {"reference_spp", std::to_string(row.block->reference.spp)},
      {"reference_relmse", number(row.block->reference.relmse)},
      {"device", row.result->use.device},
      {"ray_tracing", row.result->use.rayTracing},
      {"startup_ms", number(row.result->startupMs)},
      {"time_ratio_to_first_backend", number(row.timeToFirstBackend.value)},
      {"time_ratio_to_first_backend_ci_lo", number(row.timeToFirstBackend.lo)},
      {"time_ratio_to_first_backend_ci_hi", number(row.timeToFirstBackend.hi)},
      {"point", suite.point},
      {"parameters", parametersText(*row.method)},
      {"baseline", nameAt(suite, &Suite::baselineOf, row)},
      {"average", nameAt(suite, &Suite::average, row)},
  };
  const Interval none{kUnknown, kUnknown, kUnknown};
  const auto add = [&](const std::string& name, const Interval& interval) {
    columns.push_back({name, number(interval.value)});
    columns.push_back({name + "_ci_lo", number(interval.lo)});
    columns.push_back({name + "_ci_hi", number(interval.hi)});
  };
  add("accumulated_slope", row.convergence ? row.convergence->slope : none);
  const Convergence curve = row.convergence.value_or(Convergence());
  columns.push_back({"accumulated_points", std::to_string(curve.points.size())});
  columns.push_back(
      {"accumulated_points_fitted", suite.timing ? std::to_string(curve.fitted()) : "nan"});
  columns.push_back(
      {"accumulated_misfit_log10", number(curve.fitted() > 1 ? curve.misfit : kUnknown)});
  const CurveReading unread = {none, none, kUnknown, false, ""};
  const SpeedUp up = row.speedUp.value_or(SpeedUp{unread, unread});
  add("equal_time_mse_ratio", up.equalTime.ratio);
  add("equal_time_mse_ratio_measured", up.equalTime.measured);
  columns.push_back({"equal_time_ms", number(up.equalTime.at)});
  add("equal_error_time_ratio", up.equalError.ratio);
  add("equal_error_time_ratio_measured", up.equalError.measured);
  columns.push_back({"equal_error_mse", number(up.equalError.at)});
  TemporalSummary unmeasured = {none, none, none, kUnknown, kUnknown, {}};
  unmeasured.autocorrelation.fill(none);
  const TemporalSummary temporal = row.temporal.value_or(unmeasured);
  add("temporal_variance", temporal.variance);
  add("temporal_difference", temporal.difference);
  add("temporal_error_difference_squared", temporal.errorDifferenceSquared);
  columns.push_back({"temporal_difference_of_reference", number(temporal.referenceDifference)});
  columns.push_back(
      {"temporal_difference_of_reference_noise", number(temporal.referenceDifferenceNoise)});
  columns.push_back({"camera_path", suite.cameraPathName});
  for (size_t lag = 1; lag <= temporal.autocorrelation.size(); ++lag)
    add(fmt::format("error_autocorrelation_{}", lag), temporal.autocorrelation[lag - 1]);
  for (const auto& [name, interval] : row.figures) add(name, interval);
  for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i) {
    const char* name = Health::names()[i];
    if (!name || !*name) continue;
    columns.push_back(
        {fmt::format("health_{}", name), std::to_string(row.health.health.counts[i])});
  }
  return columns;
}

}  // namespace

std::string summaryCsv(const Suite& suite, const std::vector<MethodSummary>& rows) {
  std::string heading, lines;
  for (const MethodSummary& row : rows) {
    std::vector<Column> columns = contractColumns(suite, row);
    for (Column& column : furtherColumns(suite, row)) columns.push_back(std::move(column));
    std::string names, values;
    for (const Column& column : columns) {
      if (&column != &columns.front()) {
        names += ',';
        values += ',';
      }
      names += column.name;
      values += quoted(column.value);
    }
    heading = names;
    lines += values;
    lines += '\n';
  }
  return heading.empty() ? "" : fmt::format("{}\n{}", heading, lines);
}

}  // namespace restlab
