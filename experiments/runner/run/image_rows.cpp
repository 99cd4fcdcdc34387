#include "experiments/runner/run/image_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/reference/beside_reference.h"
#include "experiments/runner/run/figures.h"
#include "experiments/runner/run/run_record.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr const char* kScene = "{scene}";
constexpr const char* kComponent = "{component}";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Returns the file of image `run` of a row.
fs::path fileOf(const ImageRow& row, uint32_t run, const std::string& scene, uint32_t component) {
  const std::string name =
      replaced(replaced(row.files.at(run), kScene, scene), kComponent, componentName(component));
  const fs::path found = findAsset(name);
  if (!found.empty()) return found;
  std::error_code status;
  const fs::path beside = fs::path(row.folder) / name;
  return fs::exists(beside, status) ? beside : fs::path(name);
}

LayeredImage read(const ImageRow& row, const fs::path& file, uint32_t width, uint32_t height) {
  try {
    LayeredImage image = readColours(file);
    const PixelWindow window = windowOf(image.layers.at("")), wanted{{0, 0}, width, height};
    if (window != wanted) {
      failInput(fmt::format("{}: is {}, the suite's images are {}", file.string(),
                            windowText(window, wanted), windowText(wanted, window)));
    }
    return image;
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", row.filesPlace, error.what()));
  }
}

// Prevents one file from being measured against the references of several scenes or components.
void requirePlaceholder(const ImageRow& row, const char* placeholder, const char* what,
                        size_t count) {
  for (const std::string& file : row.files) {
    if (count < 2 || file.find(placeholder) != std::string::npos) continue;
    failUsage(fmt::format("{}: '{}' is one file for {} {}; name them with {}", row.filesPlace, file,
                          count, what, placeholder));
  }
}

}  // namespace

void checkImageRows(const Suite& suite, const std::string& scene, uint32_t component,
                    uint32_t width, uint32_t height,
                    const std::map<std::string, std::string>& configuration) {
  for (const SuiteMethod& method : suite.methods) {
    if (!method.images) continue;
    requirePlaceholder(*method.images, kScene, "scenes", suite.scenes.size());
    requirePlaceholder(*method.images, kComponent, "components", suite.components.size());
    for (uint32_t run = 0; run < method.images->files.size(); ++run) {
      const ImageRow& row = *method.images;
      const fs::path file = fileOf(row, run, scene, component);
      const LayeredImage image = read(row, file, width, height);
      atPlace(row.filesPlace, [&] {
        requireOfReference(file.string(), image.metadata, "scene " + scene, configuration,
                           "an image that says nothing of them is taken on trust");
      });
    }
  }
}

std::vector<fs::path> imageFiles(const Suite& suite) {
  std::vector<fs::path> files;
  for (const SuiteMethod& method : suite.methods) {
    if (!method.images) continue;
    for (uint32_t run = 0; run < method.images->files.size(); ++run) {
      for (const SuiteScene& scene : suite.scenes) {
        for (const uint32_t component : suite.components)
          files.push_back(fileOf(*method.images, run, scene.name, component));
      }
    }
  }
  return files;
}

uint32_t imageRuns(const Suite& suite) {
  size_t runs = 0;
  for (const SuiteMethod& method : suite.methods) {
    if (method.images) runs = std::max(runs, method.images->files.size());
  }
  return uint32_t(runs);
}

ImageJob measureImages(const Suite& suite, const BlockResult& block, uint32_t run,
                       const std::string& referenceHash, const std::string& startedUtc) {
  ImageJob job;
  nlohmann::ordered_json methods = nlohmann::ordered_json::array();
  std::vector<RunResult> results;
  std::vector<fs::path> files;
  for (size_t m = 0; m < suite.methods.size(); ++m) {
    const std::optional<ImageRow>& row = suite.methods[m].images;
    if (!row || run >= row->files.size()) continue;
    const fs::path file = fileOf(*row, run, block.scene, block.component);
    LayeredImage image = read(*row, file, block.width, block.height);
    RunResult& result = results.emplace_back();
    result.method = m;
    result.run = run;
    result.measured =
        measureFrame(image.layers.at(""), block.reference, suite.warmupFrames, block.withoutLights);
    result.figures = measureFigures(suite, block, image.layers.at(""));
    if (!row->timesMs.empty()) result.timesMs = {row->timesMs.at(run)};
    JobMethod& method = job.data.methods.emplace_back();
    method.measured = std::move(image.layers.at(""));
    method.metadata = std::move(image.metadata);
    method.metadata["image_file"] = file.string();
    files.push_back(file);
    methods.push_back({{"name", suite.methods[m].name},
                       {"pixels", imageHash(method.measured)},
                       {"time_ms", result.timesMs},
                       {"bias", suite.methods[m].images->bias}});
  }
  job.identity.words = {{"kind", "images"},
                        {"results_schema", kResultsSchema},
                        {"source_hash", buildInfo().sourceHash},
                        {"measuring", buildInfo().measuringHash},
                        {"compiler", buildInfo().compiler},
                        {"flags", buildInfo().compilerFlags},
                        {"build_type", buildInfo().buildType},
                        {"point", suite.point},
                        {"scene", block.scene},
                        {"component", componentName(block.component)},
                        {"run", run},
                        {"reference", referenceHash},
                        {"figures", figuresWords(suite)},
                        {"methods", std::move(methods)}};
  const std::string key = job.identity.key();
  for (size_t i = 0; i < results.size(); ++i) {
    job.data.methods[i].lines = {
        imageLine(suite, block, results[i], files[i].string(), key, startedUtc)};
  }
  return job;
}

}  // namespace restlab
