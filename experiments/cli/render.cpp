// restlab render: renders one image with one integrator, or prints the state of a pixel.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "core/base/radiance_range.h"
#include "core/frame/method.h"
#include "core/image/io/exr_limits.h"
#include "core/image/metrics/metrics.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/cli/layer_previews.h"
#include "experiments/cli/options.h"
#include "experiments/cli/render_pixel.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/statistics/image_sum.h"

namespace restlab {

namespace {

// Warm-up frames before --spp frames of a method with a history.
constexpr uint64_t kWarmupFrames = 32;
// Frames submitted to a device at once if their images are not needed. An interrupt waits for all
// of them.
constexpr uint64_t kFramesAtOnce = 4;
constexpr uint64_t kMaxCount = 1u << 30;

struct RenderOptions {
  SceneOptions scene;
  MethodOptions method;
  std::string output, png, aovs;
  uint64_t frames = 0, spp = 0;  // 0: not given
  std::string pixel;             // "": none
  bool json = false;
};

std::vector<std::string> checkedAovs(const std::string& list, const Method& method) {
  if (list.empty()) return {};
  const std::vector<std::string> known = method.aovNames();
  std::vector<std::string> names;  // without repetitions
  for (const std::string& name : splitList(list, "--aov")) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      failUsage(fmt::format("--aov {}: unknown name (known: {}){}", name, fmt::join(known, ", "),
                            didYouMean(name, known)));
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::filesystem::path pngPath(const RenderOptions& options) {
  if (!options.png.empty() && options.png != "beside") return options.png;
  return std::filesystem::path(options.output).replace_extension(".png");
}

// Result of rendering frames.
struct Rendered {
  Image image;
  HealthSum health;
  double timeMs = 0.0;  // of the frames in the image
  uint64_t spp = 1, warmup = 0, frame = 0;
};

Rendered renderFrames(Session& session, const RenderOptions& options, bool history) {
  Rendered rendered;
  const bool mean = options.spp > 0;
  rendered.spp = mean ? options.spp : 1;
  if (mean) {
    rendered.warmup = history ? kWarmupFrames : 0;
  } else {
    rendered.warmup = std::max<uint64_t>(options.frames, 1) - 1;
  }
  if (mean && history) {
    logInfo(
        fmt::format("the image is the mean of {} consecutive frames of one history after {} "
                    "warm-up frames; they are not independent samples",
                    options.spp, kWarmupFrames));
  }
  const uint64_t total = rendered.warmup + rendered.spp;
  Progress progress("frame", total);
  ImageSum sum;
  const uint64_t atOnce = session.config().backend == "cpu" ? 1 : kFramesAtOnce;
  for (uint64_t frame = 0; frame < rendered.warmup;) {
    throwIfInterrupted("the image is not finished and was not written");
    const uint64_t count = std::min(atOnce, rendered.warmup - frame);
    session.frames(uint32_t(count));
    frame += count;
    progress.update(frame);
  }
  for (uint64_t frame = rendered.warmup; frame < total; ++frame) {
    throwIfInterrupted("the image is not finished and was not written");
    const FrameStats stats = session.frame();
    progress.update(frame + 1);
    if (mean) sum.add(session.radiance());
    rendered.health.add(stats);
    rendered.timeMs += stats.timeMs;
  }
  // Keep a finished image even after a signal.
  rendered.image = mean ? sum.mean() : session.radiance();
  rendered.frame = total - 1;
  return rendered;
}

// Says how often a layer of names has each of them: "shift_outcome: accepted 71.3 %; dark 9 %".
std::string sharesOfNames(const LayerInfo& layer, const Image& image) {
  std::map<std::string, size_t> counts;
  for (const glm::vec3& number : image.pixels) ++counts[layer.wordsOf(number.x)];
  std::vector<std::pair<std::string, size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> shares;
  for (const auto& [name, count] : sorted)
    shares.push_back(
        fmt::format("{} {:.3g} %", name, 100.0 * double(count) / double(image.pixels.size())));
  return fmt::format("{}: {}", layer.name, fmt::join(shares, "; "));
}

void saySharesOfNames(const Method& method, const LayeredImage& file) {
  for (const LayerInfo* layer : method.layers())
    if (layer->wordsOf != nullptr && file.layers.contains(layer->name))
      logInfo(sharesOfNames(*layer, file.layers.at(layer->name)));
}

// Memory besides the buffers: the image, twice; the sums of its mean; AOVs as buffers and as
// layers.
size_t hostBytesPerPixel(const RenderOptions& options, const std::vector<std::string>& aovs) {
  const size_t image = sizeof(glm::vec3), sum = sizeof(glm::dvec3);
  // One more for the preview of a layer.
  const size_t aov = aovs.empty() ? 0 : Session::aovNames().size() + aovs.size() + 1;
  return 2 * image + (options.spp > 0 ? sum : 0) + aov * image;
}

LayeredImage layers(const Session& session, const PreparedScene& prepared, const Rendered& rendered,
                    const std::vector<std::string>& aovs) {
  LayeredImage file;
  for (const std::string& name : aovs) file.layers[name] = session.aov(name);
  file.layers[""] = rendered.image;
  file.metadata = describe(prepared, session.config());
  file.metadata["device"] = session.device();
  file.metadata["ray_tracing"] = session.rayTracing();
  file.metadata.merge(provenanceWords());
  file.metadata["kind"] = "image";
  file.metadata["seed"] = std::to_string(session.config().seed);
  file.metadata["spp"] = std::to_string(rendered.spp);
  file.metadata["warmup_frames"] = std::to_string(rendered.warmup);
  file.metadata["frame"] = std::to_string(rendered.frame);
  file.metadata["render_time_s"] = fmt::format("{:.6g}", rendered.timeMs / 1000.0);
  file.metadata["health"] = rendered.health.text();
  file.metadata["features_needed"] = featureNames(session.featuresNeeded());
  file.metadata["features_left_out"] = featureNames(rl::RL_FEATURE_ALL & ~session.featuresUsed());
  return file;
}

// Checks output files before anything is loaded.
void checkFiles(const RenderOptions& options, const std::vector<std::string>& aovs) {
  if (options.output.empty()) {
    if (options.pixel.empty())
      failUsage("render: --output is required, or --pixel X,Y (see restlab render --help)");
    if (!aovs.empty()) failUsage("--aov: layers go into the file of --output, which is missing");
    if (!options.png.empty()) failUsage("--png: goes with --output, which is missing");
    return;
  }
  checkWritable(options.output);
  const bool png = !options.png.empty();
  std::vector<OutputFile> outputs = {
      {"--output", options.output, ".exr", "; --png=FILE.png writes a picture beside it"}};
  if (png) {
    outputs.push_back({"--png", pngPath(options), ".png"});
    for (const std::string& name : aovs)
      outputs.push_back({"--png", layerPreviewPath(pngPath(options), name), ".png"});
  }
  checkOutputs(outputs, options.scene.request);
  if (png) checkWritable(pngPath(options));
}

void writeFiles(const RenderOptions& options, const LayeredImage& file,
                const std::vector<std::string>& aovs, const Method& method) {
  writeExr(options.output, file);
  if (options.png.empty()) return;
  writePng(pngPath(options), file.layers.at(""), 1.0f, file.metadata);
  for (const std::string& name : aovs)
    writeLayerPreview(layerPreviewPath(pngPath(options), name), name, file, method);
}

void render(RenderOptions options) {
  resolveResolution(options.scene);
  SessionConfig config = makeConfig(options.scene, options.method);
  const std::vector<std::string> aovs = checkedAovs(options.aovs, findMethod(config));
  std::optional<PixelPlace> pixel;
  if (!options.pixel.empty()) pixel = parsePixel(options.pixel);
  checkFiles(options, aovs);
  const bool isWritten = !options.output.empty();

  const PreparedScene prepared = prepareScene(options.scene.request);
  printWarnings(prepared);
  completeConfig(prepared, options.scene, config);
  if (pixel) requireInside(*pixel, config);
  if (isWritten)
    requireExrSize(options.output, config.width, config.height, 1 + uint32_t(aovs.size()));
  Session session(prepared.scene, config, hostBytesPerPixel(options, aovs));
  logStartup(session);
  const StartupReport before = session.startup();
  logDetail(fmt::format("{}: {} triangles, loaded in {:.0f} ms; {} at {}x{}",
                        prepared.scene->source().name, prepared.scene->instancedTriangleCount(),
                        prepared.loadTimeMs, config.integrator, config.width, config.height));
  const Rendered rendered =
      renderFrames(session, options, findMethod(config).hasHistory(session.config().parameters));
  std::optional<LayeredImage> file;
  if (isWritten) file = layers(session, prepared, rendered, aovs);
  StartupLog further;  // kernels of the layers
  further.add(session, before);
  further.print();
  if (file) writeFiles(options, *file, aovs, findMethod(config));
  if (file) saySharesOfNames(findMethod(config), *file);
  const std::string undrawn = session.drawnLights().text();
  if (!undrawn.empty()) logInfo(undrawn);
  if (pixel) {
    const std::string text =
        options.json ? pixelJson(session, *pixel, rendered.frame + 1) : pixelText(session, *pixel);
    print("{}", text);
  }

  const std::string outside = whyOutsideRange(*findMethod(config).denoiser, rendered.image);
  if (!outside.empty()) logWarning(fmt::format("{}: {}", options.scene.request.scene, outside));
  const size_t nonfinite = countNonfinite(rendered.image);
  const uint64_t dropped = rendered.health.health.counts[rl::RL_HEALTH_NONFINITE];
  if (nonfinite) logWarning(fmt::format("the image holds {} non-finite values", nonfinite));
  if (dropped) logWarning(fmt::format("{} non-finite sample values were set to zero", dropped));
  if (!isWritten) return;
  logInfo(fmt::format("{}: {}x{}, {:.1f} ms per frame, health: {}", options.output, config.width,
                      config.height, rendered.timeMs / double(rendered.spp),
                      rendered.health.text()));
}

}  // namespace

Action addRenderVerb(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* verb = app.add_subcommand("render", "render one image, or what is kept of a pixel");
  addSceneOptions(*verb, options->scene);
  addMethodOptions(*verb, options->method);
  addOutput(*verb, options->output);
  verb->get_option("--output")
      ->required(false)
      ->description("EXR file to write; needed unless --pixel is given");
  CLI::Option* frames = verb->add_option("--frames,--frame", options->frames,
                                         "what a viewer shows at frame N (default 1)")
                            ->transform(wholeNumberFrom(1, kMaxCount));
  CLI::Option* pixel =
      verb->add_option("--pixel", options->pixel,
                       "X,Y: print what the method keeps of that pixel of the last frame");
  verb->add_flag("--json", options->json, "as a JSON object")->needs(pixel);
  verb->add_option("--spp", options->spp, "the mean of N samples per pixel")
      ->transform(wholeNumberFrom(1, kMaxCount))
      ->excludes(frames)
      ->excludes(pixel);
  verb->add_option("--aov", options->aovs,
                   "comma-separated layers: radiance, positionW, ..., and those of the method "
                   "(list integrators, list caches)");
  verb->add_flag("--png{beside}", options->png,
                 "an sRGB preview beside the EXR, and one of each layer; --png=FILE: there");
  return [options](Outcome&) { render(*options); };
}

}  // namespace restlab
