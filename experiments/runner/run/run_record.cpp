#include "experiments/runner/run/run_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/frame/integrator.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/base/json_number.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

Json valueJson(const ParameterValue& value) {
  return std::visit([](const auto& typed) { return Json(typed); }, value);
}

Json parametersJson(const SuiteMethod& method) {
  Json json = Json::object();
  for (const auto& [key, value] : method.parameters()) json[key] = valueJson(value);
  return json;
}

Json configurationJson(const Suite& suite, const BlockResult& block, size_t method,
                       const DeviceUse& use) {
  const SessionConfig& session = suite.methods[method].session;
  Json json = {{"suite", suite.name},
               {"point", suite.point},
               {"scene", block.scene},
               {"camera", block.camera},
               {"camera_path", suite.cameraPathName},
               {"events", eventsText(suite.events, suite.warmupFrames)},
               {"component", componentName(block.component)},
               {"method", suite.methods[method].name},
               {"device", use.device},
               {"ray_tracing", use.rayTracing},
               {"kernel", kernelChoiceName(session.kernels)},
               {"parameters", parametersJson(suite.methods[method])},
               {"width", block.width},
               {"height", block.height},
               {"warmup_frames", suite.warmupFrames},
               {"timed_frames", suite.timedFrames}};
  for (const ParameterInfo& info : transportSchema().infos(suite))
    json[info.name] = valueJson(info.defaultValue);
  for (const auto& [key, value] : settingValues(session)) json[key] = value;
  return json;
}

Json referenceJson(const BlockResult& block) {
  return {{"file", block.referenceFile},
          {"spp", block.reference.spp},
          {"relmse_estimate", finiteJson(block.reference.relmse)}};
}

void addError(Json& line, const FrameError& error) {
  line["frame"] = error.frame;
  line["mse"] = finiteJson(error.mse);
  line["mse_without_lights"] = finiteJson(error.mseWithoutLights);
  line["mse_variance_of_halves_at_most"] = finiteJson(error.mseVarianceAtMost);
  line["mse_without_lights_variance_of_halves_at_most"] = finiteJson(error.insideVarianceAtMost);
  line["mse_without_lights_variance_of_halves"] = finiteJson(error.insideVarianceCommon);
  line["relmse_e1e-2"] = finiteJson(error.relmse);
  line["relmse_e1e-2_trim0.1"] = finiteJson(error.relmseTrimmed);
  line["energy_ratio"] = finiteJson(error.energyRatio);
  line["worst_0.1pct_share_of_mse"] = finiteJson(error.worstShare);
  line["nonfinite_in_image"] = error.nonfinite;
}

void addFigures(Json& line, const RunResult& run) {
  Json figures = Json::object();
  // Details that belong to a number: the pixel of an extreme, the exposures of FLIP.
  Json details = Json::object();
  for (const auto& [name, figure] : run.figures) {
    figures[name] = finiteJson(figure.value);
    if (!figure.detail.empty()) details[name] = figure.detail;
  }
  line["figures"] = std::move(figures);
  if (!details.empty()) line["figure_details"] = std::move(details);
}

void readFigures(const Json& line, RunResult& run) {
  if (!line.contains("figures")) return;
  const Json details = line.value("figure_details", Json::object());
  for (const auto& [name, value] : line.at("figures").items()) {
    run.figures.emplace_back(name,
                             MetricValue{finiteNumber(value), details.value(name, std::string())});
  }
}

Json timesJson(const RunResult& run, const std::string& backend) {
  if (run.timesMs.empty()) return {{"clock", "not measured"}, {"frames", Json::array()}};
  Json passes = Json::object();
  for (const PassTiming& pass : run.passes) passes[pass.name] = pass.timeMs;
  Json forScene = Json::object();
  for (const PassTiming& pass : run.scenePasses) forScene[pass.name] = pass.timeMs;
  const std::string clock =
      backend == "vulkan" ? "the device's timestamps, steady where it has none" : "steady";
  return {{"clock", clock + ", passes only: no metrics, no files"},
          {"median", median(run.timesMs)},
          {"p95", percentile(run.timesMs, 0.95)},
          {"frames", run.timesMs},
          {"passes_median", passes},
          {"passes_for_the_scene", forScene}};
}

Json healthJson(const HealthSum& sum) {
  Json json = Json::object();
  for (size_t i = 0; i < sum.health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (name && *name) json[name] = sum.health.counts[i];
  }
  return json;
}

FrameError errorOf(const Json& line) {
  FrameError error;
  error.frame = line.at("frame").get<uint32_t>();
  error.mse = finiteNumber(line.at("mse"));
  error.mseWithoutLights = finiteNumber(line.at("mse_without_lights"));
  error.mseVarianceAtMost = finiteNumber(line.at("mse_variance_of_halves_at_most"));
  error.insideVarianceAtMost =
      finiteNumber(line.at("mse_without_lights_variance_of_halves_at_most"));
  error.insideVarianceCommon = finiteNumber(line.at("mse_without_lights_variance_of_halves"));
  error.relmse = finiteNumber(line.at("relmse_e1e-2"));
  error.relmseTrimmed = finiteNumber(line.at("relmse_e1e-2_trim0.1"));
  error.energyRatio = finiteNumber(line.at("energy_ratio"));
  error.worstShare = finiteNumber(line.at("worst_0.1pct_share_of_mse"));
  error.nonfinite = line.at("nonfinite_in_image").get<uint64_t>();
  return error;
}

Json temporalJson(const TemporalFigures& figures) {
  Json lags = Json::array();
  for (const double value : figures.autocorrelation) lags.push_back(finiteJson(value));
  return {{"variance", finiteJson(figures.variance)},
          {"difference", finiteJson(figures.difference)},
          {"reference_difference", finiteJson(figures.referenceDifference)},
          {"reference_difference_noise", finiteJson(figures.referenceDifferenceNoise)},
          {"error_difference_squared", finiteJson(figures.errorDifferenceSquared)},
          {"autocorrelation", lags}};
}

TemporalFigures temporalOf(const Json& json) {
  TemporalFigures figures;
  figures.variance = finiteNumber(json.at("variance"));
  figures.difference = finiteNumber(json.at("difference"));
  figures.referenceDifference = finiteNumber(json.at("reference_difference"));
  figures.referenceDifferenceNoise = finiteNumber(json.at("reference_difference_noise"));
  figures.errorDifferenceSquared = finiteNumber(json.at("error_difference_squared"));
  for (size_t lag = 0; lag < figures.autocorrelation.size(); ++lag)
    figures.autocorrelation[lag] = finiteNumber(json.at("autocorrelation").at(lag));
  return figures;
}

Health healthOf(const Json& json) {
  Health health;
  for (size_t i = 0; i < health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (name && *name) health.counts[i] = json.at(name).get<uint64_t>();
  }
  return health;
}

}  // namespace

Json imageLine(const Suite& suite, const BlockResult& block, const RunResult& run,
               const std::string& file, const std::string& job, const std::string& startedUtc) {
  Json line = {{"schema", kResultsSchema},
               {"job", job},
               {"started", startedUtc},
               {"finished", utcNow()},
               {"suite", suite.name},
               {"point", suite.point},
               {"scene", block.scene},
               {"camera", block.camera},
               {"component", componentName(block.component)},
               {"method", suite.methods[run.method].name},
               {"integrator", suite.methods[run.method].session.integrator},
               {"file", file},
               {"width", block.width},
               {"height", block.height},
               {"run", run.run},
               {"kind", "image"},
               {"reference", referenceJson(block)},
               {"source_hash", buildInfo().sourceHash},
               {"provenance", provenanceJson()}};
  addError(line, run.measured);
  addFigures(line, run);
  line["time_ms"] = {{"clock", "as the suite says"}, {"frames", run.timesMs}};
  return line;
}

std::vector<Json> runLines(const Suite& suite, const BlockResult& block, const MethodResult& method,
                           const RunResult& run, const std::string& job,
                           const std::string& startedUtc) {
  Json line = {
      {"schema", kResultsSchema}, {"job", job}, {"started", startedUtc}, {"finished", utcNow()}};
  line.update(configurationJson(suite, block, run.method, method.use));
  line["run"] = run.run;
  line["seed"] = run.seed;
  line["features_left_out"] = method.featuresLeftOut;
  line["light_left_out"] = method.lightLeftOut;
  line["bytes_per_pixel"] = method.bytesPerPixel;
  line["startup_ms"] = method.startupMs;
  line["code_bytes"] = method.codeBytes;
  line["reference"] = referenceJson(block);
  line["source_hash"] = buildInfo().sourceHash;
  line["provenance"] = provenanceJson();

  std::vector<Json> lines;
  for (const AgedError& aged : run.aged) {
    Json at = line;
    at["kind"] = "age";
    at["age"] = aged.age;
    at["time_ms_of_frame"] = finiteJson(aged.timeMs);
    addError(at, aged.error);
    lines.push_back(std::move(at));
  }
  for (const AccumulatedError& point : run.accumulated) {
    Json at = line;
    at["kind"] = "accumulated";
    at["frames_accumulated"] = point.frames;
    at["time_ms_since_start"] = finiteJson(point.timeMs);
    addError(at, point.error);
    lines.push_back(std::move(at));
  }
  const double samples = double(suite.timedFrames) * double(block.width) * double(block.height);
  line["kind"] = "run";
  addError(line, run.measured);
  addFigures(line, run);
  line["time_ms"] = timesJson(run, suite.methods[run.method].session.backend);
  line["rays_path"] = run.health.raysPath;
  line["rays_shadow"] = run.health.raysShadow;
  line["path_rays_per_pixel"] = double(run.health.raysPath) / samples;
  line["shadow_rays_per_pixel"] = double(run.health.raysShadow) / samples;
  if (run.temporal) line["temporal"] = temporalJson(*run.temporal);
  for (const double residual : run.residuals) line["residuals"].push_back(finiteJson(residual));
  line["health"] = healthJson(run.health);
  line["health_of_warmup"] = healthJson(run.warmupHealth);
  lines.push_back(std::move(line));
  return lines;
}

RunResult runOfLines(const std::vector<Json>& lines, MethodResult& method) {
  RunResult run;
  bool isWhole = false;
  for (const Json& line : lines) {
    if (line.at("schema").get<int>() != kResultsSchema)
      throw std::invalid_argument("lines of another schema");
    const std::string kind = line.at("kind").get<std::string>();
    if (kind == "age") {
      run.aged.push_back({line.at("age").get<uint32_t>(), finiteNumber(line.at("time_ms_of_frame")),
                          errorOf(line)});
      continue;
    }
    if (kind == "accumulated") {
      run.accumulated.push_back({line.at("frames_accumulated").get<uint32_t>(),
                                 finiteNumber(line.at("time_ms_since_start")), errorOf(line)});
      continue;
    }
    if (kind == "image") {
      isWhole = true;
      run.run = line.at("run").get<uint32_t>();
      run.measured = errorOf(line);
      readFigures(line, run);
      run.timesMs = line.at("time_ms").at("frames").get<std::vector<double>>();
      method.featuresLeftOut = "none";
      continue;
    }
    if (kind != "run") throw std::invalid_argument("lines of an unknown kind");
    isWhole = true;
    run.run = line.at("run").get<uint32_t>();
    run.seed = line.at("seed").get<uint32_t>();
    run.measured = errorOf(line);
    run.timesMs = line.at("time_ms").at("frames").get<std::vector<double>>();
    readFigures(line, run);
    if (!run.timesMs.empty()) {
      for (const auto& [name, timeMs] : line.at("time_ms").at("passes_median").items())
        run.passes.push_back({name, timeMs.get<double>(), 0, 0});
      const Json forScene = line.at("time_ms").value("passes_for_the_scene", Json::object());
      for (const auto& [name, timeMs] : forScene.items())
        run.scenePasses.push_back({name, timeMs.get<double>(), 0, 0, true});
    }
    for (const Json& residual : line.value("residuals", Json::array()))
      run.residuals.push_back(finiteNumber(residual));
    run.health.health = healthOf(line.at("health"));
    run.warmupHealth.health = healthOf(line.at("health_of_warmup"));
    run.health.raysPath = line.at("rays_path").get<uint64_t>();
    run.health.raysShadow = line.at("rays_shadow").get<uint64_t>();
    if (line.contains("temporal")) run.temporal = temporalOf(line.at("temporal"));
    method.featuresLeftOut = line.at("features_left_out").get<std::string>();
    // Older lines have it from the method alone.
    if (line.contains("light_left_out"))
      method.lightLeftOut = line.at("light_left_out").get<std::string>();
    else if (line.contains("integrator"))
      method.lightLeftOut = findIntegrator(line.at("integrator").get<std::string>()).leavesOut;
    method.bytesPerPixel = line.at("bytes_per_pixel").get<size_t>();
    method.codeBytes = line.at("code_bytes").get<size_t>();
    method.startupMs = std::max(method.startupMs, line.at("startup_ms").get<double>());
    method.use.backend = line.at("backend").get<std::string>();
    method.use.device = line.at("device").get<std::string>();
    method.use.rayTracing = line.at("ray_tracing").get<std::string>();
    const Json machine = line.value("provenance", Json::object()).value("machine", Json::object());
    const std::string processor =
        method.use.backend == "cpu" ? machine.value("cpu", "unknown processor") + ", " : "";
    run.machine = processor + method.use.device;
  }
  if (!isWhole) throw std::invalid_argument("no line of kind run or image");
  return run;
}

}  // namespace restlab
