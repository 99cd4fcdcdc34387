// restlab denoise: a denoiser over images that were rendered before, here or elsewhere.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>

#include "core/changes/settings.h"
#include "core/image_denoiser.h"
#include "core/method.h"
#include "experiments/cli/frame_files.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/run/interrupt.h"
#include "experiments/runner/run/log.h"
#include "experiments/runner/summary/accumulate.h"

namespace restlab {

namespace {

struct DenoiseOptions {
  std::string input, output, denoiser = "svgf", layers;
  std::vector<std::string> parameters;
  BackendChoice backend;
  int threads = 0;
  double radianceFrames = 1.0;
};

// What a layer is for, and the names that it usually has: ours first.
struct LayerKind {
  const char* name;
  std::vector<std::string> usual;
  Image LayeredFrame::*into;
  const char* without;  // what is taken for it where it is missing
};

const std::vector<LayerKind>& layerKinds() {
  static const std::vector<LayerKind> kinds = {
      {"radiance",
       {"", "radiance", "Combined", "beauty", "color"},
       &LayeredFrame::radiance,
       nullptr},
      {"normal", {"normalW", "normal", "Normal", "N"}, &LayeredFrame::normalW, nullptr},
      {"depth", {"depth", "Depth", "Z"}, &LayeredFrame::depthMetres, nullptr},
      {"albedo",
       {"albedo", "Albedo", "Denoising Albedo"},
       &LayeredFrame::albedo,
       "it is not divided by"},
      {"emission", {"emission", "Emit", "emit"}, &LayeredFrame::lights, "no light is in view"},
      {"motion", {"motion", "velocity"}, &LayeredFrame::motion, "nothing has moved"}};
  return kinds;
}

// "normal=N,depth=Z" by kind; "" in the place of a name: without that layer.
std::map<std::string, std::string> namedLayers(const std::string& list) {
  std::map<std::string, std::string> named;
  if (list.empty()) return named;
  std::vector<std::string> kinds;
  for (const LayerKind& kind : layerKinds()) kinds.emplace_back(kind.name);
  for (const std::string& item : splitList(list, "--layers")) {
    const size_t equals = item.find('=');
    const std::string kind = item.substr(0, equals);
    if (equals == std::string::npos || std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
      failUsage(fmt::format("--layers {}: must be KIND=NAME, KIND one of {}{}", item,
                            fmt::join(kinds, ", "), didYouMean(kind, kinds)));
    }
    named[kind] = item.substr(equals + 1);
  }
  return named;
}

// The name of a kind's layer in a file; nothing where there is none and none is needed.
std::optional<std::string> findLayer(const std::filesystem::path& file, const LayeredImage& image,
                                     const LayerKind& kind,
                                     const std::map<std::string, std::string>& named) {
  const auto there = [&] {
    std::vector<std::string> names;
    for (const auto& [name, layer] : image.layers) names.push_back(name.empty() ? "(none)" : name);
    return names;
  };
  if (const auto given = named.find(kind.name); given != named.end()) {
    if (given->second.empty() && kind.without != nullptr) return std::nullopt;
    if (given->second.empty() && kind.into != &LayeredFrame::radiance)
      failUsage(fmt::format("--layers {}=: it cannot be left out, name a layer", kind.name));
    if (image.layers.contains(given->second)) return given->second;
    failInput(fmt::format("{}: has no layer '{}' for {} (layers: {}){}", file.string(),
                          given->second, kind.name, fmt::join(there(), ", "),
                          didYouMean(given->second, there())));
  }
  for (const std::string& name : kind.usual) {
    if (image.layers.contains(name)) return name;
  }
  if (kind.without != nullptr) return std::nullopt;
  failInput(fmt::format("{}: has no layer for {} (layers: {}); name it with --layers {}=NAME",
                        file.string(), kind.name, fmt::join(there(), ", "), kind.name));
}

// `missing`: the kinds of which it was said that a frame has none.
LayeredFrame readFrame(const std::filesystem::path& file, const LayeredImage& image,
                       const DenoiseOptions& options, std::set<std::string>& missing) {
  const std::map<std::string, std::string> named = namedLayers(options.layers);
  LayeredFrame frame;
  for (const LayerKind& kind : layerKinds()) {
    const std::optional<std::string> name = findLayer(file, image, kind, named);
    if (name) {
      frame.*kind.into = image.layers.at(*name);
    } else if (missing.insert(kind.name).second) {
      logInfo(fmt::format("{}: no layer for {}: {}", file.string(), kind.name, kind.without));
    }
  }
  return frame;
}

void denoise(const DenoiseOptions& options) {
  SessionConfig config;
  config.denoiser = options.denoiser;
  const Method method = findMethod(config);
  applyBackend(options.backend, config);
  config.threads = options.threads;
  config.parameters = parseParameters(method.denoiser->parameters, "denoiser " + options.denoiser,
                                      options.parameters);
  for (const ParameterInfo& parameter : method.denoiser->parameters) {
    if (!parameter.needs.empty() && config.parameters.contains(parameter.name))
      logWarning(fmt::format("{} has no effect: layers of an image do not have '{}'",
                             parameter.name, parameter.needs));
  }
  if (method.denoiser->defaults.contains(kValidateEvery))
    logWarning(options.denoiser +
               ": no path of an image can be traced again, light that changes is not found");
  const std::vector<FrameFiles> files = frameFiles(options.input, options.output);
  std::unique_ptr<ImageDenoiser> denoiser;
  HealthSum health;
  double timeMs = 0.0;
  std::set<std::string> missing;
  Progress progress("frame", files.size());
  for (size_t i = 0; i < files.size(); ++i) {
    throwIfInterrupted("the frames that are left were not written");
    LayeredImage image = readExr(files[i].input, ExrLayers::all);
    const LayeredFrame frame = readFrame(files[i].input, image, options, missing);
    if (denoiser == nullptr) {
      config.width = frame.radiance.width;
      config.height = frame.radiance.height;
      denoiser = std::make_unique<ImageDenoiser>(config);
    }
    if (frame.radiance.width != config.width || frame.radiance.height != config.height) {
      failInput(fmt::format("{}: is {}x{}, the frames before it are {}x{}", files[i].input.string(),
                            frame.radiance.width, frame.radiance.height, config.width,
                            config.height));
    }
    LayeredImage out;
    out.metadata = image.metadata;
    out.layers[""] = denoiser->frame(frame, float(options.radianceFrames));
    out.metadata["denoiser"] = options.denoiser;
    health.add(denoiser->stats());
    timeMs += denoiser->stats().timeMs;
    writeExr(files[i].output, out);
    progress.update(i + 1);
  }
  progress.finish();
  logInfo(fmt::format("{}: {} frames, {:.1f} ms per frame, health: {}", options.output,
                      files.size(), timeMs / double(files.size()), health.text()));
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
                   "frames that the radiance averages itself, as resampled frames do (default 1)")
      ->transform(numberFrom(1.0, 1e6));
  verb->add_option("--set", options->parameters, "KEY=VALUE: a parameter of the denoiser")
      ->take_all()
      ->allow_extra_args(false);
  addBackendOptions(*verb, options->backend);
  addThreads(*verb, options->threads);
  return [options](Outcome&) { denoise(*options); };
}

}  // namespace restlab
