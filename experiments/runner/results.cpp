// results.jsonl lines and the images of a block.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/image/intervals.h"
#include "experiments/runner/build_info.h"
#include "experiments/runner/files.h"
#include "experiments/runner/report.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no NaN and no infinity: they become strings, not a silent null.
Json finite(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

Json parametersJson(const SessionConfig& config) {
  Json json = Json::object();
  for (const auto& [key, value] :
       resolveParameters(findIntegrator(config.integrator), config.parameters)) {
    std::visit([&, &name = key](const auto& typed) { json[name] = typed; }, value);
  }
  return json;
}

Json configurationJson(const Suite& suite, const BlockResult& block, size_t method) {
  const SessionConfig& session = suite.methods[method].session;
  return {{"suite", suite.name},
          {"scene", block.scene},
          {"camera", block.camera},
          {"component", componentName(block.component)},
          {"method", suite.methods[method].name},
          {"integrator", session.integrator},
          {"mode", session.mode},
          {"cache", hasHistory(session) ? session.cache : "none"},
          {"backend", session.backend},
          {"device", block.methods[method].use.device},
          {"ray_tracing", block.methods[method].use.rayTracing},
          {"denoiser", session.denoiser},
          {"kernel", session.specialise ? "specialised" : "general"},
          {"parameters", parametersJson(session)},
          {"width", block.width},
          {"height", block.height},
          {"max_bounces", suite.maxBounces},
          {"multiscatter", suite.multiscatter},
          {"russian_roulette", suite.russianRoulette},
          {"filter", filterName(suite.pixelFilter)},
          {"warmup_frames", suite.warmupFrames},
          {"timed_frames", suite.timedFrames}};
}

void addError(Json& line, const FrameError& error) {
  line["frame"] = error.frame;
  line["mse"] = finite(error.mse);
  line["mse_without_lights"] = finite(error.mseWithoutLights);
  line["relmse_e1e-2"] = finite(error.relmse);
  line["relmse_e1e-2_trim0.1"] = finite(error.relmseTrimmed);
  line["energy_ratio"] = finite(error.energyRatio);
  line["worst_0.1pct_share_of_mse"] = finite(error.worstShare);
  line["nonfinite_in_image"] = error.nonfinite;
}

Json timesJson(const RunResult& run, const std::string& backend) {
  Json passes = Json::object();
  for (const PassTiming& pass : run.passes) passes[pass.name] = pass.timeMs;
  const std::string clock =
      backend == "vulkan" ? "the device's timestamps, steady where it has none" : "steady";
  return {{"clock", clock + ", passes only: no metrics, no files"},
          {"median", median(run.timesMs)},
          {"p95", percentile(run.timesMs, 0.95)},
          {"frames", run.timesMs},
          {"passes_median", passes}};
}

Json healthJson(const HealthSum& sum) {
  Json json = Json::object();
  for (size_t i = 0; i < sum.health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (name && *name) json[name] = sum.health.counts[i];
  }
  return json;
}

// Exposure that brings the reference's mean luminance to mid grey.
float previewExposure(const Image& reference) {
  double sum = 0.0;
  for (const glm::vec3& pixel : reference.pixels) {
    const double luminance = 0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z;
    // The mean of logarithms: a lamp in view does not darken the picture.
    sum += std::log(std::max(luminance, 1e-4));
  }
  return float(0.18 / std::exp(sum / double(reference.pixels.size())));
}

}  // namespace

std::string blockLabel(const BlockResult& block) {
  return safeFileName(block.scene + "-" + componentName(block.component));
}

std::vector<std::string> resultLines(const Suite& suite, const BlockResult& block,
                                     const RunResult& run, const std::string& startedUtc) {
  Json line = {{"schema", kResultsSchema}, {"started", startedUtc}, {"finished", utcNow()}};
  line.update(configurationJson(suite, block, run.method));
  line["run"] = run.run;
  line["seed"] = run.seed;
  line["features_left_out"] = featuresLeftOut(block.methods[run.method]);
  line["bytes_per_pixel"] = block.methods[run.method].bytesPerPixel;
  line["startup_ms"] = block.methods[run.method].startupMs;
  line["reference"] = {{"file", block.referenceFile},
                       {"spp", block.reference.spp},
                       {"relmse_estimate", finite(block.reference.relmse)}};
  line["source_hash"] = buildInfo().sourceHash;

  std::vector<std::string> lines;
  for (const FrameError& checkpoint : run.checkpoints) {
    Json at = line;
    at["kind"] = "checkpoint";
    addError(at, checkpoint);
    lines.push_back(at.dump());
  }
  const double samples = double(run.timesMs.size()) * double(block.width) * double(block.height);
  line["kind"] = "run";
  addError(line, run.measured);
  line["time_ms"] = timesJson(run, suite.methods[run.method].session.backend);
  line["path_rays_per_pixel"] = double(run.health.raysPath) / samples;
  line["shadow_rays_per_pixel"] = double(run.health.raysShadow) / samples;
  line["health"] = healthJson(run.health);
  lines.push_back(line.dump());
  return lines;
}

void writeBlockImages(const std::filesystem::path& folder, const Suite& suite,
                      const BlockResult& block) {
  makeWritableDirectory(folder);
  const float exposure = previewExposure(block.reference.mean);
  const std::string label = blockLabel(block);
  const auto write = [&](const std::string& name, const Image& image,
                         std::map<std::string, std::string> metadata) {
    LayeredImage file;
    file.layers[""] = image;
    file.metadata = std::move(metadata);
    file.metadata["preview_exposure"] = fmt::format("{:.6g}", exposure);
    const std::string stem = label + "-" + safeFileName(name);
    writeExr(folder / (stem + ".exr"), file);
    writePng(folder / (stem + ".png"), image, exposure);
  };
  write("reference", block.reference.mean, block.reference.metadata);
  for (size_t m = 0; m < block.methods.size(); ++m) {
    const MethodResult& method = block.methods[m];
    if (!method.runs.empty()) write(suite.methods[m].name, method.shown, method.metadata);
  }
}

}  // namespace restlab
