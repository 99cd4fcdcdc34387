// restlab bench: rays per second, paths per second, error per CPU second, bytes per pixel.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "core/image/intervals.h"
#include "core/image/metrics.h"
#include "experiments/cli/bench_embree.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/build_info.h"
#include "experiments/runner/interrupt.h"
#include "experiments/runner/light_mask.h"
#include "experiments/runner/log.h"
#include "experiments/runner/reference.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

struct BenchOptions {
  SceneOptions scene;
  uint32_t frames = 16;
  uint64_t referenceSpp = 128;
  double seconds = 1.0;
  bool json = false;
};

struct FrameRates {
  double timeMs = 0.0, p95Ms = 0.0, cpuS = 0.0;
  double raysPath = 0.0, raysShadow = 0.0;  // per frame
};

FrameRates measureFrames(Session& session, uint32_t frames) {
  constexpr uint32_t kWarmup = 4;  // caches, page faults, the clock's frequency
  for (uint32_t i = 0; i < kWarmup; ++i) session.frame();
  std::vector<double> times;
  FrameRates rates;
  for (uint32_t i = 0; i < frames; ++i) {
    throwIfInterrupted("the benchmark is not finished");
    const double cpuBefore = processCpuSeconds();
    const FrameStats stats = session.frame();
    rates.cpuS += (processCpuSeconds() - cpuBefore) / frames;
    times.push_back(stats.timeMs);
    rates.raysPath += double(stats.raysPath) / frames;
    rates.raysShadow += double(stats.raysShadow) / frames;
  }
  rates.timeMs = median(times);
  rates.p95Ms = percentile(times, 0.95);
  return rates;
}

// MSE of single frames over the pixels that show no light, times the CPU seconds of a frame. Both
// scale as 1/N and N with the number of samples: the product does not depend on it.
Json errorPerCpuSecond(const PreparedScene& prepared, const SessionConfig& config,
                       const BenchOptions& options) {
  ReferenceTarget target;
  target.spp = options.referenceSpp;
  const Reference reference = renderReference(prepared, referenceConfigOf(config), target);
  const std::vector<uint8_t> mask = pixelsWithoutLights(prepared, config);
  uint64_t pixels = 0;
  for (const uint8_t value : mask) pixels += value;
  if (pixels == 0) return nullptr;

  Session session(prepared.scene, config);
  const double cpuBefore = processCpuSeconds();
  double cpuS = 0.0;
  std::vector<double> errors;
  for (uint32_t i = 0; i < options.frames; ++i) {
    const double before = processCpuSeconds();
    session.frame();
    cpuS += (processCpuSeconds() - before) / options.frames;
    errors.push_back(
        mseAgainstHalves(session.radiance(), *reference.half0, *reference.half1, mask));
  }
  logDetail(
      fmt::format("error per CPU second: {:.1f} CPU seconds", processCpuSeconds() - cpuBefore));
  const Interval mse = meanInterval(errors);  // frames of path are independent
  return {{"pixels_without_lights", pixels},
          {"mse_per_frame", mse.value},
          {"mse_ci", {mse.lo, mse.hi}},
          {"cpu_seconds_per_frame", cpuS},
          {"mse_times_cpu_seconds", mse.value * cpuS},
          {"reference_spp", reference.spp}};
}

Json frameJson(const PreparedScene& prepared, SessionConfig config, const BenchOptions& options,
               const EmbreeRates& embree) {
  Session session(prepared.scene, config);
  const FrameRates rates = measureFrames(session, options.frames);
  const double pixels = double(config.width) * config.height;
  const double seconds = rates.timeMs / 1000.0;
  const double rays = rates.raysPath + rates.raysShadow;
  // What Embree alone would take for as many rays: a lower bound of the share that perf measures.
  const double alone = (embree.incoherent > 0.0 ? rates.raysPath / embree.incoherent : 0.0) +
                       (embree.shadow > 0.0 ? rates.raysShadow / embree.shadow : 0.0);
  Json buffers = Json::object();
  for (const auto& [name, bytes] : session.bufferBytesPerPixel()) buffers[name] = bytes;
  return {{"integrator", config.integrator},
          {"mode", session.config().mode},
          {"time_ms_median", rates.timeMs},
          {"time_ms_p95", rates.p95Ms},
          {"cpu_seconds_per_frame", rates.cpuS},
          {"pixels_per_second", pixels / seconds},
          {"pixels_per_cpu_second", pixels / rates.cpuS},
          {"path_rays_per_pixel", rates.raysPath / pixels},
          {"shadow_rays_per_pixel", rates.raysShadow / pixels},
          {"rays_per_second", rays / seconds},
          {"embree_alone_share_of_time", alone / seconds},
          {"bytes_per_pixel", session.bytesPerPixel()},
          {"mib_at_1920x1080", double(session.bytesPerPixel()) * 1920.0 * 1080.0 / (1 << 20)},
          {"buffers", buffers}};
}

void printText(const Json& json) {
  const Json& embree = json["embree_rays_per_second"];
  fmt::print("{}, {}x{}, {} scattering events; {}\n\n", json["scene"].get<std::string>(),
             json["width"].get<uint32_t>(), json["height"].get<uint32_t>(),
             json["max_bounces"].get<uint32_t>(), json["machine"]["cpu"].get<std::string>());
  fmt::print("Embree alone     million rays per second\n");
  for (const char* kind : {"primary", "shadow", "incoherent"}) {
    fmt::print("  {:<14} {:8.2f}\n", kind, embree[kind].get<double>() / 1e6);
  }
  fmt::print("\n{:<10} {:<10} {:>9} {:>9} {:>8} {:>11} {:>8} {:>9} {:>9} {:>8}\n", "integrator",
             "mode", "ms/frame", "p95", "Mpix/s", "Mpix/CPU-s", "rays/px", "Mrays/s", "Embree %",
             "bytes/px");
  for (const Json& frame : json["frames"]) {
    fmt::print(
        "{:<10} {:<10} {:>9.2f} {:>9.2f} {:>8.2f} {:>11.2f} {:>8.2f} {:>9.2f} {:>9.0f} {:>8}\n",
        frame["integrator"].get<std::string>(), frame["mode"].get<std::string>(),
        frame["time_ms_median"].get<double>(), frame["time_ms_p95"].get<double>(),
        frame["pixels_per_second"].get<double>() / 1e6,
        frame["pixels_per_cpu_second"].get<double>() / 1e6,
        frame["path_rays_per_pixel"].get<double>() + frame["shadow_rays_per_pixel"].get<double>(),
        frame["rays_per_second"].get<double>() / 1e6,
        100.0 * frame["embree_alone_share_of_time"].get<double>(),
        frame["bytes_per_pixel"].get<size_t>());
  }
  const Json& error = json["path_error"];
  if (!error.is_null()) {
    fmt::print("\npath, pixels that show no light: MSE {:.4g} per frame x {:.4g} CPU s = {:.4g}\n",
               error["mse_per_frame"].get<double>(), error["cpu_seconds_per_frame"].get<double>(),
               error["mse_times_cpu_seconds"].get<double>());
  }
  fmt::print("peak resident memory {:.0f} MiB\n", json["peak_resident_mib"].get<double>());
}

void bench(BenchOptions options) {
  resolveResolution(options.scene);
  if (!options.scene.width && !options.scene.height)
    options.scene.width = options.scene.height = 512;
  const PreparedScene prepared = prepareScene(options.scene.request);
  printWarnings(prepared);
  SessionConfig config = makeConfig(options.scene, MethodOptions());
  completeConfig(prepared, config);

  logInfo("measuring Embree alone");
  const EmbreeRates embree =
      measureEmbree(prepared, config.width, config.height, config.threads, options.seconds);
  Json frames = Json::array();
  for (const IntegratorInfo* info : integratorRegistry()) {
    for (const ModeInfo& mode : info->modes) {
      logInfo(fmt::format("measuring {} {}", info->name, mode.name));
      SessionConfig method = config;
      method.integrator = info->name;
      method.mode = mode.name;
      frames.push_back(frameJson(prepared, method, options, embree));
    }
  }
  Json json = {
      {"scene", prepared.scene->source().name},
      {"width", config.width},
      {"height", config.height},
      {"max_bounces", config.maxBounces},
      {"multiscatter", config.multiscatter},
      {"machine", machineJson()},
      {"build", buildJson()},
      {"embree_rays_per_second",
       {{"primary", embree.primary}, {"shadow", embree.shadow}, {"incoherent", embree.incoherent}}},
      {"frames", frames},
      {"path_error", errorPerCpuSecond(prepared, config, options)}};
  json["peak_resident_mib"] = peakResidentMiB();
  if (options.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    printText(json);
  }
}

}  // namespace

Action addBenchVerb(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  options->scene.request.scene = "cornell-box";
  CLI::App* verb = app.add_subcommand("bench", "rays, paths and error per second; bytes per pixel");
  addSceneOptions(*verb, options->scene);
  verb->get_option("scene")->required(false);
  verb->add_option("--frames", options->frames, "timed frames of each method (default 16)")
      ->check(CLI::Range(1u, 100000u));
  verb->add_option("--seconds", options->seconds, "for each kind of ray through Embree alone")
      ->check(finiteRange(0.01, 600.0));
  verb->add_option("--reference-spp", options->referenceSpp, "for the error (default 128)")
      ->check(CLI::Range(uint64_t(2), uint64_t(1) << 20));
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options](Outcome&) { bench(*options); };
}

}  // namespace restlab
