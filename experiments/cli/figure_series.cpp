#include "experiments/cli/figure_series.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "core/image/io/atomic_file.h"
#include "experiments/cli/matte_scene.h"
#include "experiments/cli/options.h"
#include "experiments/report/series.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/suite/prepare.h"
#include "experiments/runner/tables/preview.h"
#include "experiments/statistics/image_sum.h"

namespace restlab {

namespace {

constexpr uint32_t kSeriesWidth = 320;
constexpr uint64_t kMostSeriesPixels = uint64_t(1) << 26;

// One picture of a series: a method on the scene, or on what of it is matte.
struct SeriesStep {
  const char* label;
  const char* integrator;
  ParameterMap parameters;
  bool isMatte = false;
  bool seesLightsAlone = false;
};

// A scene as lectures build it up.
const std::vector<SeriesStep>& courseSteps() {
  static const std::vector<SeriesStep> steps = {
      {"light sources", "path", {}, false, true},
      {"direct light", "local", {{"shadows", std::string("none")}}, true},
      {"shadows", "local", {{"shadows", std::string("rays")}}, true},
      {"indirect light", "path", {}, true},
      {"glass and mirrors", "path", {}}};
  return steps;
}

Image renderStep(const SeriesStep& step, const std::shared_ptr<const CompiledScene>& scene,
                 SessionConfig config, uint32_t spp) {
  config.integrator = step.integrator;
  config.parameters = step.parameters;
  if (step.seesLightsAlone) config.maxBounces = 0;
  Session session(scene, config, sizeof(glm::vec3) * (courseSteps().size() + 2));
  ImageSum sum;
  for (uint32_t frame = 0; frame < spp; ++frame) {
    throwIfInterrupted("the figure is not finished and was not written");
    session.frame();
    sum.add(session.radiance());
  }
  return sum.mean();
}

double meanRadiance(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += double(p.x + p.y + p.z) / 3.0;
  return sum / double(image.pixels.size());
}

}  // namespace

void makeSeries(const SeriesOptions& options) {
  if (options.name != "course")
    failUsage(
        fmt::format("--series {}: there is none of that name; 'course' is one", options.name));
  const std::filesystem::path output = options.output;
  const bool isSvg = output.extension() == ".svg", isPng = output.extension() == ".png";
  if (!isSvg && !isPng)
    failUsage(fmt::format("--output {}: must be named *.svg or *.png", options.output));
  checkWritable(output);
  SceneRequest request;
  request.scene = options.scene;
  const PreparedScene prepared = prepareScene(request);
  printWarnings(prepared);
  SceneOptions size;
  SessionConfig config;
  config.width = options.width;
  config.height = options.height;
  if (config.width == 0 && config.height == 0) config.width = kSeriesWidth;
  completeConfig(prepared, size, config);
  const uint64_t all = uint64_t(config.width) * config.height * courseSteps().size();
  if (all > kMostSeriesPixels)
    failUsage(
        fmt::format("--resolution {}x{}: the figure would have {} million pixels; choose "
                    "smaller pictures",
                    config.width, config.height, all / 1'000'000));

  const auto matte = CompiledScene::build(matteScene(prepared.scene->source()));
  std::vector<SeriesPicture> pictures;
  std::map<std::string, std::string> words = provenanceWords();
  for (const SeriesStep& step : courseSteps()) {
    pictures.push_back(
        {step.label, renderStep(step, step.isMatte ? matte : prepared.scene, config, options.spp)});
    const std::string key = fmt::format("picture{}", pictures.size());
    words[key] = step.label;
    words[key + ".mean_radiance"] = fmt::format("{:.6g}", meanRadiance(pictures.back().image));
  }
  float exposure = float(options.exposure);
  if (exposure == 0.0f) exposure = previewExposure(pictures.back().image);
  const std::string title = options.title.empty() ? prepared.scene->source().name : options.title;
  words["kind"] = "figure";
  words["series"] = options.name;
  words["scene"] = options.scene;
  words["spp"] = std::to_string(options.spp);
  words["exposure"] = fmt::format("{:.6g}", exposure);
  const Figure figure = layOutSeries(pictures, title, exposure);
  for (const std::string& label : figure.cutLabels)
    logWarning(fmt::format("'{}' does not fit its picture and is cut (--resolution)", label));
  writeTextFile(output, isSvg ? figureSvg(figure) : figurePng(figure, words));
  logInfo(fmt::format("{}: {:.0f}x{:.0f} pixels, {} pictures of {}, exposure {:.4g}",
                      options.output, figure.width, figure.height, pictures.size(), options.scene,
                      exposure));
}

}  // namespace restlab
