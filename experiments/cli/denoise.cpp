// restlab denoise: applies a denoiser to images rendered before, also by other programs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/base/radiance_range.h"
#include "core/frame/image_denoiser.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/image/io/exr_contents.h"
#include "core/temporal_gradients/settings.h"
#include "experiments/cli/frame_files.h"
#include "experiments/cli/frame_layers.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"

namespace restlab {

namespace {

struct DenoiseOptions {
  std::string input, output, denoiser = "svgf", layers;
  bool png = false;
  std::vector<std::string> parameters;
  BackendChoice backend;
  int threads = 0;
  std::optional<double> radianceFrames;
};

// Parameter of denoisers that need to know over how many frames the radiance was averaged.
constexpr const char* kAsksRadianceFrames = "svgf_confidence";

bool asksRadianceFrames(const DenoiserInfo& denoiser, const ParameterMap& given) {
  if (const auto found = given.find(kAsksRadianceFrames); found != given.end())
    return std::get<bool>(found->second);
  for (const ParameterInfo& parameter : denoiser.parameters) {
    if (parameter.name == kAsksRadianceFrames) return std::get<bool>(parameter.defaultValue);
  }
  return false;
}

// Throws Error (badUsage) if a denoiser needs more inputs than layers.
void requireLayersAlone(const DenoiserInfo& denoiser) {
  if (!denoiser.needsSurfaces) return;
  failUsage(
      fmt::format("--denoiser {}: asks the scene what each pixel shows, which an image does "
                  "not hold; render --denoiser {} has it, svgf does without",
                  denoiser.name, denoiser.name));
}

SessionConfig configOf(const DenoiseOptions& options) {
  SessionConfig config;
  config.denoiser = options.denoiser;
  const DenoiserInfo& denoiser = *findMethod(config).denoiser;
  requireLayersAlone(denoiser);
  applyBackend(options.backend, config);
  config.threads = options.threads;
  // Parameters of change detection belong to `render`, and are unknown here.
  config.parameters = parseParameters(
      denoiser.parameters, "denoiser " + options.denoiser + " on an image", options.parameters);
  for (const ParameterInfo& parameter : denoiser.parameters) {
    if (!parameter.needs.empty() && config.parameters.contains(parameter.name))
      logWarning(fmt::format("{} has no effect: layers of an image do not have '{}'",
                             parameter.name, parameter.needs));
  }
  if (denoiser.defaults.contains(kValidateEvery))
    logWarning(options.denoiser +
               ": no path of an image can be traced again, light that changes is not found");
  const bool asks = asksRadianceFrames(denoiser, config.parameters);
  if (options.radianceFrames && !asks)
    logWarning(
        fmt::format("--radiance-frames has no effect: {} does not ask for it, svgf_restir "
                    "does",
                    denoiser.name));
  if (!options.radianceFrames && asks)
    logWarning(
        "without --radiance-frames frames are taken to share no samples, as those of path "
        "do; docs/manual.md has values for restir_gi");
  return config;
}

// Checks all files before one is written. Returns the names of their layers, and their size in
// `config`. All files must have the same window.
std::vector<LayerNames> checkFrames(const std::vector<FrameFiles>& files, const FrameLayers& layers,
                                    SessionConfig& config) {
  std::vector<LayerNames> names;
  std::set<std::string> said;
  PixelWindow first;
  for (const FrameFiles& frame : files) {
    const ExrContents contents = readExrContents(frame.input, ExrLayers::all);
    names.push_back(layers.find(frame.input, contents.layers));
    for (const auto& [kind, without] : FrameLayers::missing(names.back())) {
      if (said.insert(kind).second)
        logInfo(fmt::format("{}: no layer for {}: {}", frame.input.string(), kind, without));
    }
    if (names.size() == 1) first = contents.window;
    if (contents.window != first) {
      failInput(fmt::format("{}: is {}, the frames before it are {}", frame.input.string(),
                            windowText(contents.window, first),
                            windowText(first, contents.window)));
    }
  }
  config.width = first.width;
  config.height = first.height;
  return names;
}

// Returns the metadata of the input, and how it was denoised.
std::map<std::string, std::string> metadataOf(const std::map<std::string, std::string>& input,
                                              const std::filesystem::path& file,
                                              const SessionConfig& config,
                                              const ImageDenoiser& denoiser) {
  std::map<std::string, std::string> words = provenanceWords();
  words["input"] = file.string();
  words["denoiser"] = config.denoiser;
  HealthSum health;
  health.add(denoiser.stats());
  words["denoiser_health"] = health.text();
  words["denoiser_time_s"] = fmt::format("{:.6g}", denoiser.stats().timeMs / 1000.0);
  for (const auto& [name, value] : denoiser.parameters())
    words["parameter." + name] = parameterText(value);
  words.insert(input.begin(), input.end());
  return words;
}

void denoise(const DenoiseOptions& options) {
  SessionConfig config = configOf(options);
  const FrameLayers layers(options.layers);
  const std::vector<FrameFiles> files = frameFiles(options.input, options.output);
  const std::vector<LayerNames> names = checkFrames(files, layers, config);
  ImageDenoiser denoiser(config);
  HealthSum health;
  double timeMs = 0.0;
  bool isOutsideSaid = false;
  Progress progress("frame", files.size());
  for (size_t i = 0; i < files.size(); ++i) {
    throwIfInterrupted("the frames that are left were not written");
    const LayeredImage image = readExr(files[i].input, FrameLayers::selection(names[i]));
    sayNotes(files[i].input, image);
    LayeredImage out;
    out.frame = image.frame;
    out.layers[""] = denoiser.frame(FrameLayers::frame(image, names[i]),
                                    float(options.radianceFrames.value_or(1.0)));
    const std::string outside = whyOutsideRange(*findMethod(config).denoiser, out.layers[""]);
    if (!outside.empty() && !std::exchange(isOutsideSaid, true))
      logWarning(fmt::format("{}: {}", files[i].input.string(), outside));
    out.metadata = metadataOf(image.metadata, files[i].input, config, denoiser);
    health.add(denoiser.stats());
    timeMs += denoiser.stats().timeMs;
    writeExr(files[i].output, out);
    if (options.png)
      writePng(std::filesystem::path(files[i].output).replace_extension(".png"), out.layers[""],
               1.0f, out.metadata);
    progress.update(i + 1);
  }
  progress.finish();
  logInfo(fmt::format("{}: {} frame{}, {:.1f} ms per frame, health: {}", options.output,
                      files.size(), files.size() == 1 ? "" : "s", timeMs / double(files.size()),
                      health.text()));
}

}  // namespace

Action addDenoiseVerb(CLI::App& app) {
  auto options = std::make_shared<DenoiseOptions>();
  CLI::App* verb = app.add_subcommand("denoise", "a denoiser over rendered images");
  verb->add_option("input", options->input,
                   "an EXR with layers; with ### in its name a sequence, numbers in their order")
      ->required();
  verb->add_option("-o,--output", options->output, "the EXR to write; with as many # as the input")
      ->required();
  verb->add_option("--denoiser", options->denoiser, "restlab list denoisers (default svgf)");
  verb->add_option("--layers", options->layers,
                   "KIND=NAME,...: names of layers; kinds are radiance, normal, depth, albedo, "
                   "emission, motion");
  verb->add_option("--radiance-frames", options->radianceFrames,
                   "frames that the radiance averages itself, as resampled frames do (default 1); "
                   "for svgf_restir")
      ->transform(numberFrom(1.0, 1e6));
  verb->add_option("--set", options->parameters, "KEY=VALUE: a parameter of the denoiser")
      ->take_all()
      ->allow_extra_args(false);
  verb->add_flag("--png", options->png, "an sRGB preview beside each EXR");
  addBackendOptions(*verb, options->backend);
  addThreads(*verb, options->threads);
  return [options](Outcome&) { denoise(*options); };
}

}  // namespace restlab
