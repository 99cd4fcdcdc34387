// restlab bench: rays per second, paths per second, error per CPU second, bytes per pixel.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/frame/denoiser.h"
#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/frame/method_settings.h"
#include "core/image/metrics/metrics.h"
#include "experiments/cli/bench_first_hits.h"
#include "experiments/cli/bench_rays.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/run/light_mask.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

struct BenchOptions {
  SceneOptions scene;
  BackendChoice backend;
  uint32_t frames = 16;
  uint64_t referenceSpp = 128;
  double seconds = 1.0;
  bool raysAlone = false;
  bool firstHits = false;
  bool json = false;
};

// Averages or medians over the frames of one session.
struct FrameRates {
  double timeMs = 0.0, p95Ms = 0.0, cpuS = 0.0;
  double raysPath = 0.0, raysShadow = 0.0;  // per frame
  std::vector<PassTiming> passes;           // median time
};

// Interleaves the sessions frame by frame, so that a slowdown of the machine affects all of them.
std::vector<FrameRates> measureFrames(const std::vector<std::unique_ptr<Session>>& sessions,
                                      uint32_t frames) {
  constexpr uint32_t kWarmup = 4;  // for caches, page faults, clock frequency
  std::vector<FrameRates> rates(sessions.size());
  std::vector<std::vector<double>> times(sessions.size());
  std::vector<std::vector<std::vector<double>>> passTimes(sessions.size());
  for (uint32_t i = 0; i < kWarmup + frames; ++i) {
    for (size_t s = 0; s < sessions.size(); ++s) {
      throwIfInterrupted("the benchmark is not finished");
      const double cpuBefore = processCpuSeconds();
      const FrameStats stats = sessions[s]->frame();
      if (i < kWarmup) continue;
      rates[s].cpuS += (processCpuSeconds() - cpuBefore) / frames;
      times[s].push_back(stats.timeMs);
      rates[s].raysPath += double(stats.raysPath) / frames;
      rates[s].raysShadow += double(stats.raysShadow) / frames;
      passTimes[s].resize(stats.passes.size());
      for (size_t p = 0; p < stats.passes.size(); ++p)
        passTimes[s][p].push_back(stats.passes[p].timeMs);
      rates[s].passes = stats.passes;
    }
  }
  for (size_t s = 0; s < sessions.size(); ++s) {
    rates[s].timeMs = median(times[s]);
    rates[s].p95Ms = percentile(times[s], 0.95);
    for (size_t p = 0; p < rates[s].passes.size(); ++p)
      rates[s].passes[p].timeMs = median(passTimes[s][p]);
  }
  return rates;
}

// Returns the MSE of single frames over pixels without lights, times the CPU seconds of a frame.
// The product does not depend on the number of samples N, because the factors scale as 1/N and N.
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
    session.reset(session.config().seed + 1);  // independent frames: no shared history
    const double before = processCpuSeconds();
    session.frame();
    cpuS += (processCpuSeconds() - before) / options.frames;
    errors.push_back(
        mseAgainstHalves(session.radiance(), *reference.half0, *reference.half1, mask));
  }
  logDetail(
      fmt::format("error per CPU second: {:.1f} CPU seconds", processCpuSeconds() - cpuBefore));
  const Interval mse = meanInterval(errors);
  return {{"pixels_without_lights", pixels},
          {"mse_per_frame", mse.value},
          {"mse_ci", {mse.lo, mse.hi}},
          {"cpu_seconds_per_frame", cpuS},
          {"mse_times_cpu_seconds", mse.value * cpuS},
          {"reference_spp", reference.spp}};
}

// Compares each pass with its lower bound: the time of its rays alone, and of copying the
// integrator's buffers once.
Json passesJson(const Session& session, const FrameRates& rates, const BackendRates& roofs) {
  const double pixels = double(session.config().width) * session.config().height;
  double bytes = 0.0;  // of buffers that share memory, too: passes read and write them
  for (const GraphBuffer& buffer : session.graph().buffers())
    if (buffer.features == 0 || (buffer.features & session.featuresUsed()) != 0)
      bytes += double(buffer.bytes());
  Json passes = Json::array();
  for (const PassTiming& pass : rates.passes) {
    double raysS = 0.0;
    if (pass.raysPath > 0) raysS += double(pass.raysPath) / roofs.incoherent;
    if (pass.raysShadow > 0) raysS += double(pass.raysShadow) / roofs.shadow;
    const double bytesS = bytes / roofs.bytesPerSecond;
    const double roofMs = 1e3 * std::max(raysS, bytesS);
    passes.push_back({{"name", pass.name},
                      {"time_ms_median", pass.timeMs},
                      {"rays_per_pixel", double(pass.raysPath + pass.raysShadow) / pixels},
                      {"rays_alone_ms", 1e3 * raysS},
                      {"buffers_once_ms", 1e3 * bytesS},
                      {"time_over_roof", pass.timeMs / roofMs}});
  }
  return passes;
}

// Compares a denoiser's passes with the time to read and write its inputs and buffers once. Passes
// of neither the denoiser nor the integrator count as guides.
Json denoiserJson(const Session& session, const FrameRates& rates, const BackendRates& roofs) {
  const SessionConfig& config = session.config();
  const DenoiserInfo& denoiser = findDenoiser(config.denoiser);
  const FrameGraph& graph = session.graph();
  const auto isOf = [&](const std::string& part, const std::string& pass) {
    const std::vector<const GraphPass*> own = graph.passesOf(part);
    return std::any_of(own.begin(), own.end(),
                       [&](const GraphPass* info) { return info->name == pass; });
  };
  double ofDenoiser = 0.0, ofIntegrator = 0.0, ofGuides = 0.0;
  for (const PassTiming& pass : rates.passes) {
    const bool isFilter = isOf(denoiser.name, pass.name) || pass.name == denoiser.name;
    const bool isIntegrator = isOf(config.integrator, pass.name);
    (isFilter ? ofDenoiser : isIntegrator ? ofIntegrator : ofGuides) += pass.timeMs;
  }
  std::set<std::string> touched;
  for (const GraphPass* pass : graph.passesOf(denoiser.name)) {
    for (const std::vector<Buffer>* buffers : {&pass->read, &pass->written})
      for (const Buffer buffer : *buffers) touched.insert(graph.buffers()[buffer.index].name);
  }
  if (denoiser.onHost) touched = {"radiance", "guide"};
  double bytes = 0.0;
  for (const auto& [name, bytesPerPixel] : session.bufferBytesPerPixel()) {
    if (touched.contains(name)) bytes += double(bytesPerPixel) * config.width * config.height;
  }
  const double onceMs = 1e3 * bytes / roofs.bytesPerSecond;
  return {{"time_ms", ofDenoiser},
          {"guides_ms", ofGuides},
          {"share_of_integrator", ofDenoiser / ofIntegrator},
          {"share_with_guides", (ofDenoiser + ofGuides) / ofIntegrator},
          {"buffers_once_ms", onceMs},
          {"time_over_buffers_once", ofDenoiser / onceMs}};
}

Json frameJson(const Session& session, const FrameRates& rates, const EmbreeRates& embree,
               const BackendRates& roofs) {
  const SessionConfig& config = session.config();
  const double pixels = double(config.width) * config.height;
  const double seconds = rates.timeMs / 1000.0;
  const double rays = rates.raysPath + rates.raysShadow;
  // Time of Embree alone for as many rays: a lower bound of the share that perf measures.
  const double alone = (embree.incoherent > 0.0 ? rates.raysPath / embree.incoherent : 0.0) +
                       (embree.shadow > 0.0 ? rates.raysShadow / embree.shadow : 0.0);
  Json buffers = Json::object();
  for (const auto& [name, bytes] : session.bufferBytesPerPixel()) buffers[name] = bytes;
  Json json = {{"time_ms_median", rates.timeMs},
               {"time_ms_p95", rates.p95Ms},
               {"cpu_seconds_per_frame", rates.cpuS},
               {"pixels_per_second", pixels / seconds},
               {"pixels_per_cpu_second", pixels / rates.cpuS},
               {"path_rays_per_pixel", rates.raysPath / pixels},
               {"shadow_rays_per_pixel", rates.raysShadow / pixels},
               {"rays_per_second", rays / seconds},
               {"embree_alone_share_of_time", alone / seconds},
               {"passes", passesJson(session, rates, roofs)},
               {"bytes_per_pixel", session.bytesPerPixel()},
               {"mib_at_1920x1080",
                double(session.bytesPerPixelOf(1920, 1080)) * 1920.0 * 1080.0 / (1 << 20)},
               {"buffers", buffers}};
  for (const auto& [key, value] : settingValues(config)) json[key] = value;
  if (config.denoiser != "none") json["denoising"] = denoiserJson(session, rates, roofs);
  return json;
}

struct BenchedMethod {
  std::string integrator, mode, denoiser;
};

// Returns each mode of each integrator without a denoiser, and each denoiser on the first of them.
std::vector<BenchedMethod> benchedMethods() {
  std::vector<BenchedMethod> methods;
  for (const IntegratorInfo* info : integratorRegistry())
    for (const ModeInfo& mode : info->modes) methods.push_back({info->name, mode.name, "none"});
  const BenchedMethod first = methods.front();
  for (const DenoiserInfo* info : denoiserRegistry())
    if (info->name != "none") methods.push_back({first.integrator, first.mode, info->name});
  return methods;
}

Json ratesJson(const BackendRates& rates, const std::string& backend, const std::string& device,
               const std::string& rayTracing) {
  return {{"backend", backend},
          {"device", device},
          {"ray_tracing", rayTracing},
          {"primary_rays_per_second", rates.primary},
          {"shadow_rays_per_second", rates.shadow > 0.0 ? Json(rates.shadow) : Json()},
          {"incoherent_rays_per_second", rates.incoherent},
          {"copied_bytes_per_second", rates.bytesPerSecond}};
}

void printRates(const Json& backends) {
  print("\n{:<8} {:<8} {:>8} {:>8} {:>10}   million rays per second; GB/s of a copy\n", "kernels",
        "rays by", "primary", "shadow", "incoherent");
  for (const Json& rates : backends) {
    print("{:<8} {:<8} {:>8.2f} {:>8} {:>10.2f}   {:.1f} GB/s   {}\n",
          rates["backend"].get<std::string>(), rates["ray_tracing"].get<std::string>(),
          rates["primary_rays_per_second"].get<double>() / 1e6,
          rates["shadow_rays_per_second"].is_null()
              ? std::string("-")
              : fmt::format("{:.2f}", rates["shadow_rays_per_second"].get<double>() / 1e6),
          rates["incoherent_rays_per_second"].get<double>() / 1e6,
          rates["copied_bytes_per_second"].get<double>() / 1e9, rates["device"].get<std::string>());
  }
}

void printMeasured(const Json& json) {
  const Json& embree = json["embree_rays_per_second"];
  print("{}, {}x{}, {} scattering events; {}\n\n", json["scene"].get<std::string>(),
        json["width"].get<uint32_t>(), json["height"].get<uint32_t>(),
        json["max_bounces"].get<uint32_t>(), json["machine"]["cpu"].get<std::string>());
  print("Embree {} alone   million rays per second\n", json["embree_version"].get<std::string>());
  for (const char* kind : {"primary", "shadow", "incoherent"}) {
    print("  {:<14} {:8.2f}\n", kind, embree[kind].get<double>() / 1e6);
  }
  printRates(json["backends"]);
  print("\n{:<10} {:<9} {:<8} {:>9} {:>9} {:>8} {:>11} {:>8} {:>9} {:>9} {:>8}\n", "integrator",
        "mode", "backend", "ms/frame", "p95", "Mpix/s", "Mpix/CPU-s", "rays/px", "Mrays/s",
        "Embree %", "bytes/px");
  for (const Json& frame : json["frames"]) {
    print(
        "{:<10} {:<9} {:<8} {:>9.2f} {:>9.2f} {:>8.2f} {:>11.2f} {:>8.2f} {:>9.2f} {:>9.0f} "
        "{:>8}\n",
        frame["integrator"].get<std::string>(), frame["mode"].get<std::string>(),
        frame["backend"].get<std::string>(), frame["time_ms_median"].get<double>(),
        frame["time_ms_p95"].get<double>(), frame["pixels_per_second"].get<double>() / 1e6,
        frame["pixels_per_cpu_second"].get<double>() / 1e6,
        frame["path_rays_per_pixel"].get<double>() + frame["shadow_rays_per_pixel"].get<double>(),
        frame["rays_per_second"].get<double>() / 1e6,
        100.0 * frame["embree_alone_share_of_time"].get<double>(),
        frame["bytes_per_pixel"].get<size_t>());
    for (const Json& pass : frame["passes"]) {
      print(
          "  {:<27} {:>9.2f}   {:.2f} rays/px; rays alone {:.2f} ms, buffers once {:.2f} "
          "ms: {:.1f} x the longer\n",
          pass["name"].get<std::string>(), pass["time_ms_median"].get<double>(),
          pass["rays_per_pixel"].get<double>(), pass["rays_alone_ms"].get<double>(),
          pass["buffers_once_ms"].get<double>(), pass["time_over_roof"].get<double>());
    }
    if (frame.contains("denoising")) {
      const Json& d = frame["denoising"];
      print(
          "  {:<27} {:>9.2f}   {:.0f} % of {}, with guides {:.0f} %; inputs and buffers once "
          "{:.2f} ms: {:.1f} x\n",
          frame["denoiser"].get<std::string>() + " in all", d["time_ms"].get<double>(),
          100.0 * d["share_of_integrator"].get<double>(), frame["integrator"].get<std::string>(),
          100.0 * d["share_with_guides"].get<double>(), d["buffers_once_ms"].get<double>(),
          d["time_over_buffers_once"].get<double>());
    }
    if (frame.contains("time_over_cpu")) {
      print("  {:<27} {:>9.2f} x the CPU's time\n", "", frame["time_over_cpu"].get<double>());
    }
  }
  const Json& error = json["path_error"];
  if (!error.is_null()) {
    print("\npath, pixels that show no light: MSE {:.4g} per frame x {:.4g} CPU s = {:.4g}\n",
          error["mse_per_frame"].get<double>(), error["cpu_seconds_per_frame"].get<double>(),
          error["mse_times_cpu_seconds"].get<double>());
  }
  print("peak resident memory {:.0f} MiB\n", json["peak_resident_mib"].get<double>());
}

// Measures lines across the scene on the backends of `configs`, one after the other.
void benchLines(const PreparedScene& prepared, const std::vector<SessionConfig>& configs,
                const BenchOptions& options) {
  const RaySets rays = makeLines(prepared, configs[0].width, configs[0].height);
  Json backends = Json::array();
  for (const SessionConfig& c : configs) {
    const BackendOptions chosen{c.threads, c.device, c.rayTracing, c.validate};
    const std::unique_ptr<Backend> backend = makeBackend(c.backend, prepared.scene, chosen);
    backends.push_back(ratesJson(measureBackend(prepared, c.backend, chosen, rays, options.seconds),
                                 c.backend, backend->device(), backend->rayTracing()));
  }
  if (options.json) {
    const Json json = {{"scene", prepared.scene->source().name},
                       {"width", configs[0].width},
                       {"height", configs[0].height},
                       {"machine", machineJson()},
                       {"build", buildJson()},
                       {"backends", backends}};
    printJsonText(json.dump(2));
  } else {
    print("{}: rays of the camera, and lines between points of a sphere around the scene\n",
          prepared.scene->source().name);
    printRates(backends);
  }
}

void bench(BenchOptions options) {
  resolveResolution(options.scene);
  if (!options.scene.width && !options.scene.height)
    options.scene.width = options.scene.height = 512;
  const PreparedScene prepared = prepareScene(options.scene.request);
  printWarnings(prepared);
  MethodOptions chosen;
  chosen.backend = options.backend;
  SessionConfig config = makeConfig(options.scene, chosen);
  completeConfig(prepared, options.scene, config);
  // Measure the requested backend and the CPU, interleaved.
  std::vector<SessionConfig> configs = {config};
  if (config.backend != "cpu") {
    SessionConfig cpu = config;
    cpu.backend = "cpu";
    cpu.device.clear();
    cpu.rayTracing.clear();
    cpu.validate = false;
    configs.insert(configs.begin(), cpu);
  }

  if (options.firstHits) return benchFirstHits(prepared, config, options.seconds, options.json);
  if (options.raysAlone) return benchLines(prepared, configs, options);
  if ((prepared.scene->features() & rl::RL_FEATURE_SHAPES) != 0)
    failUsage(
        fmt::format("bench {}: frames are compared with rays among triangles, and this scene has "
                    "shapes; give --rays-alone, or time frames with run",
                    prepared.scene->source().name));
  logInfo("measuring rays alone");
  const RaySets rays = makeRays(prepared, config.width, config.height);
  const EmbreeRates embree = measureEmbree(prepared, rays, config.threads, options.seconds);
  std::vector<BackendRates> roofs;
  Json backends = Json::array();
  for (const SessionConfig& c : configs) {
    roofs.push_back(measureBackend(prepared, c.backend,
                                   {c.threads, c.device, c.rayTracing, c.validate}, rays,
                                   options.seconds));
  }
  Json frames = Json::array();
  for (const BenchedMethod& method : benchedMethods()) {
    logInfo(fmt::format("measuring {} {}{}{}", method.integrator, method.mode,
                        method.denoiser == "none" ? "" : " + ",
                        method.denoiser == "none" ? "" : method.denoiser));
    std::vector<std::unique_ptr<Session>> sessions;
    for (SessionConfig c : configs) {
      c.integrator = method.integrator;
      c.mode = method.mode;
      c.denoiser = method.denoiser;
      sessions.push_back(std::make_unique<Session>(prepared.scene, c));
      logStartup(*sessions.back());
      if (backends.size() < configs.size()) {
        backends.push_back(ratesJson(roofs[backends.size()], c.backend, sessions.back()->device(),
                                     sessions.back()->rayTracing()));
      }
    }
    const std::vector<FrameRates> rates = measureFrames(sessions, options.frames);
    for (size_t i = 0; i < sessions.size(); ++i) {
      frames.push_back(frameJson(*sessions[i], rates[i], embree, roofs[i]));
      if (i > 0) frames.back()["time_over_cpu"] = rates[i].timeMs / rates[0].timeMs;
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
      {"embree_version", embree.version},
      {"embree_rays_per_second",
       {{"primary", embree.primary}, {"shadow", embree.shadow}, {"incoherent", embree.incoherent}}},
      {"backends", backends},
      {"frames", frames},
      {"path_error", errorPerCpuSecond(prepared, configs.front(), options)}};
  json["peak_resident_mib"] = peakResidentMiB();
  if (options.json) {
    printJsonText(json.dump(2));
  } else {
    printMeasured(json);
  }
}

}  // namespace

Action addBenchVerb(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  options->scene.request.scene = "cornell-box";
  CLI::App* verb = app.add_subcommand("bench", "rays, paths and error per second; bytes per pixel");
  addSceneOptions(*verb, options->scene);
  verb->get_option("scene")->required(false);
  addBackendOptions(*verb, options->backend);
  verb->add_option("--frames", options->frames, "timed frames of each method (default 16)")
      ->transform(wholeNumberFrom(1, 100000));
  verb->add_option("--seconds", options->seconds, "for each kind of ray alone (default 1)")
      ->transform(numberFrom(0.01, 600.0, "seconds"));
  verb->add_option("--reference-spp", options->referenceSpp, "for the error (default 128)")
      ->transform(wholeNumberFrom(2, uint64_t(1) << 20));
  verb->add_flag("--rays-alone", options->raysAlone,
                 "rays of the camera and lines across the scene, and nothing else")
      ->excludes("--frames")
      ->excludes("--reference-spp");
  verb->add_flag("--first-hits", options->firstHits,
                 "the surfaces that pixels show, by rays and by the rasteriser, at four sizes")
      ->excludes("--frames")
      ->excludes("--reference-spp")
      ->excludes("--rays-alone");
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options](Outcome&) { bench(*options); };
}

}  // namespace restlab
