// restlab figure: makes a crop strip for a paper, or the series of a scene.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/image/io/atomic_file.h"
#include "experiments/cli/figure_series.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/report/figure.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/beside_reference.h"
#include "experiments/runner/reference/reference_error.h"
#include "experiments/runner/tables/preview.h"

namespace restlab {

namespace {

struct FigureOptions {
  std::string reference, output, labels, title, metric = "mse";
  std::vector<std::string> images, crops;
  double exposure = 0.0;  // 0: of the reference
  uint32_t scale = 0;     // 0: from the crops
  bool cropErrors = false, anyReference = false;
  std::string series, resolution;
  uint32_t spp = 64;
};

// Approximate width of a crop in the figure, in pixels.
constexpr uint32_t kCellWidth = 160;
constexpr uint32_t kMaxScale = 64;
// Limit for the whole figure; a page holds far less.
constexpr uint64_t kMaxFigurePixels = uint64_t(1) << 26;

Crop parseCrop(const std::string& text) {
  uint32_t numbers[4] = {};
  const char *at = text.data(), *end = at + text.size();
  for (size_t i = 0; i < 4; ++i) {
    const auto [next, status] = std::from_chars(at, end, numbers[i]);
    const bool last = i == 3;
    if (status != std::errc() || (last ? next != end : next == end || *next != ',')) {
      failUsage(
          fmt::format("--crop {}: must be X,Y,W,H in whole pixels, for example 40,30,64,48", text));
    }
    at = next + 1;
  }
  const Crop crop = {numbers[0], numbers[1], numbers[2], numbers[3]};
  if (crop.width == 0 || crop.height == 0) failUsage(fmt::format("--crop {}: is empty", text));
  return crop;
}

std::vector<Crop> parseCrops(const std::vector<std::string>& texts) {
  std::vector<Crop> crops;
  for (const std::string& text : texts) {
    const Crop crop = parseCrop(text);
    if (!crops.empty() && (crop.width != crops[0].width || crop.height != crops[0].height)) {
      failUsage(fmt::format("--crop {}: all crops must have one size, the first has {}x{}", text,
                            crops[0].width, crops[0].height));
    }
    crops.push_back(crop);
  }
  return crops;
}

// Returns the length of the common prefix of all names up to and including a '-'; 0 if that would
// leave one name empty.
size_t commonFront(const std::vector<std::string>& names) {
  size_t length = names.front().size();
  for (const std::string& name : names) {
    const auto end = std::mismatch(name.begin(), name.begin() + std::min(length, name.size()),
                                   names.front().begin());
    length = size_t(end.first - name.begin());
  }
  const size_t dash = names.front().substr(0, length).rfind('-');
  if (dash == std::string::npos) return 0;
  const bool isRest = std::all_of(names.begin(), names.end(),
                                  [&](const std::string& name) { return name.size() > dash + 1; });
  return isRest ? dash + 1 : 0;
}

// Returns "path" and "gi" for cornell-box-all-path.exr and cornell-box-all-gi.exr. For a single
// image the prefix is found with the name of the reference.
std::vector<std::string> namesOf(const FigureOptions& options) {
  std::vector<std::string> names;
  for (const std::string& image : options.images)
    names.push_back(std::filesystem::path(image).stem().string());
  std::vector<std::string> compared = names;
  if (names.size() == 1)
    compared.push_back(std::filesystem::path(options.reference).stem().string());
  const size_t front = commonFront(compared);
  for (std::string& name : names) name.erase(0, front);
  return names;
}

std::vector<std::string> labelsOf(const FigureOptions& options) {
  std::vector<std::string> labels = namesOf(options);
  labels.emplace_back("reference");
  if (options.labels.empty()) return labels;
  std::vector<std::string> given = splitList(options.labels, "--labels");
  if (given.size() == options.images.size()) given.emplace_back("reference");
  if (given.size() != labels.size()) {
    failUsage(fmt::format("--labels {}: has {} labels for {} images (one more names the reference)",
                          options.labels, given.size(), options.images.size()));
  }
  return given;
}

Image cropped(const Image& image, const Crop& crop) {
  Image out(crop.width, crop.height);
  for (uint32_t y = 0; y < crop.height; ++y) {
    for (uint32_t x = 0; x < crop.width; ++x) out.at(x, y) = image.at(crop.x + x, crop.y + y);
  }
  return out;
}

Reference cropped(const Reference& reference, const Crop& crop) {
  Reference out;
  out.mean = cropped(reference.mean, crop);
  if (reference.half0) out.half0 = cropped(*reference.half0, crop);
  if (reference.half1) out.half1 = cropped(*reference.half1, crop);
  return out;
}

// Marks the best finite error of several, if the metric has a better end.
void markBest(const MetricInfo& metric, const std::vector<double>& errors,
              std::vector<FigureColumn>& columns) {
  if (metric.name == "energy_ratio" || errors.size() < 2) return;
  size_t best = errors.size();
  for (size_t i = 0; i < errors.size(); ++i) {
    if (!std::isfinite(errors[i])) continue;
    const bool isBetter =
        best == errors.size() ||
        (metric.higherIsBetter ? errors[i] > errors[best] : errors[i] < errors[best]);
    if (isBetter) best = i;
  }
  if (best < errors.size()) columns[best].best = true;
}

uint32_t scaleOf(const FigureOptions& options, const std::vector<Crop>& crops) {
  if (options.scale) return options.scale;
  return std::clamp((kCellWidth + crops[0].width / 2) / crops[0].width, 1u, kMaxScale);
}

void checkFigureSize(const FigureSpec& spec) {
  const uint64_t width = uint64_t(spec.crops[0].width) * spec.scale * spec.columns.size();
  const uint64_t height = uint64_t(spec.crops[0].height) * spec.scale * spec.crops.size();
  // The whole image is scaled to the height of the crops.
  const uint64_t full = height * spec.full->width / spec.full->height;
  if ((width + full) * height > kMaxFigurePixels) {
    failUsage(
        fmt::format("--scale {}: the figure would have {}x{} pixels; choose smaller crops or "
                    "a smaller scale",
                    spec.scale, width + full, height));
  }
}

// Returns the metadata of a figure's PNG: its own, the reference's, and what differs in each
// image's.
std::map<std::string, std::string> wordsOf(
    const FigureOptions& options, const FigureSpec& spec, const Reference& reference,
    const std::vector<std::map<std::string, std::string>>& images) {
  std::map<std::string, std::string> words = provenanceWords();
  const std::map<std::string, std::string> provenance = words;
  words["kind"] = "figure";
  words["reference"] = options.reference;
  words["images"] = fmt::format("{}", fmt::join(options.images, ", "));
  words["crops"] = fmt::format("{}", fmt::join(options.crops, " "));
  words["metric"] = spec.metric;
  words["exposure"] = fmt::format("{:.6g}", spec.exposure);
  for (const auto& [key, value] : reference.metadata)
    if (!provenance.contains(key)) words["reference." + key] = value;
  for (size_t i = 0; i < images.size(); ++i) {
    for (const auto& [key, value] : images[i]) {
      const auto same = reference.metadata.find(key);
      const bool differs = same == reference.metadata.end() || same->second != value;
      if (differs && !provenance.contains(key))
        words[fmt::format("image{}.{}", i + 1, key)] = value;
    }
  }
  return words;
}

void makeFigure(const FigureOptions& options) {
  const std::filesystem::path output = options.output;
  const bool isSvg = output.extension() == ".svg", isPng = output.extension() == ".png";
  if (!isSvg && !isPng) {
    failUsage(fmt::format("--output {}: must be named *.svg or *.png", options.output));
  }
  for (const auto& [option, isMissing] :
       {std::pair("--ref", options.reference.empty()), std::pair("--crop", options.crops.empty())})
    if (isMissing) failUsage(fmt::format("{} is required", option));
  const MetricInfo& metric = findMetric(options.metric);
  const std::vector<std::string> labels = labelsOf(options);
  FigureSpec spec;
  spec.crops = parseCrops(options.crops);
  spec.scale = scaleOf(options, spec.crops);
  checkWritable(output);

  const Reference reference = readReference(options.reference);
  warnOfNoReference(options.reference, reference);
  for (size_t i = 0; i < spec.crops.size(); ++i) {
    const Crop& crop = spec.crops[i];
    if (uint64_t(crop.x) + crop.width > reference.mean.width ||
        uint64_t(crop.y) + crop.height > reference.mean.height) {
      failUsage(fmt::format("--crop {}: is not inside {}x{} pixels", options.crops[i],
                            reference.mean.width, reference.mean.height));
    }
  }
  std::vector<Image> images;
  images.reserve(options.images.size());  // columns point into this vector
  std::vector<std::map<std::string, std::string>> words;
  std::vector<double> errors;
  for (size_t i = 0; i < options.images.size(); ++i) {
    LayeredImage read =
        readBeside(options.images[i], options.reference, reference, options.anyReference);
    words.push_back(std::move(read.metadata));
    const Image& image = images.emplace_back(std::move(read.layers.at("")));
    if (const size_t nonfinite = countNonfinite(image)) {
      logWarning(fmt::format("{}: holds {} non-finite values", options.images[i], nonfinite));
    }
    FigureColumn& column = spec.columns.emplace_back();
    column.label = labels[i];
    column.image = &image;
    errors.push_back(errorAgainst(metric.name, image, reference).value);
    column.error = fmt::format("{:.3g}", errors.back());
    if (!options.cropErrors) continue;
    for (const Crop& crop : spec.crops) {
      const double error =
          errorAgainst(metric.name, cropped(image, crop), cropped(reference, crop)).value;
      column.cropErrors.push_back(fmt::format("{:.3g}", error));
    }
  }
  markBest(metric, errors, spec.columns);
  FigureColumn& last = spec.columns.emplace_back();
  last.label = labels.back();
  last.image = &reference.mean;
  last.cropErrors.assign(options.cropErrors ? spec.crops.size() : 0, "");
  spec.full = &reference.mean;
  const auto scene = reference.metadata.find("scene");
  spec.fullLabel = !options.title.empty()              ? options.title
                   : scene != reference.metadata.end() ? scene->second
                                                       : labels.back();
  spec.metric = metric.name;
  spec.exposure =
      options.exposure > 0.0 ? float(options.exposure) : previewExposure(reference.mean);
  checkFigureSize(spec);

  const Figure figure = layOutFigure(spec);
  for (const std::string& label : figure.cutLabels) {
    logWarning(
        fmt::format("'{}' does not fit above its column and is cut (--labels, --scale)", label));
  }
  writeTextFile(output, isSvg ? figureSvg(figure)
                              : figurePng(figure, wordsOf(options, spec, reference, words)));
  logInfo(fmt::format("{}: {:.0f}x{:.0f} pixels, {} crops of {} images, exposure {:.4g}",
                      options.output, figure.width, figure.height, spec.crops.size(),
                      spec.columns.size(), spec.exposure));
}

void makeFigureOfScene(const FigureOptions& options) {
  if (options.images.size() != 1)
    failUsage(
        fmt::format("--series {}: takes one scene, not {}", options.series, options.images.size()));
  for (const auto& [option, isGiven] :
       {std::pair("--ref", !options.reference.empty()), std::pair("--crop", !options.crops.empty()),
        std::pair("--labels", !options.labels.empty()), std::pair("--scale", options.scale != 0),
        std::pair("--crop-errors", options.cropErrors)})
    if (isGiven) failUsage(fmt::format("{}: goes with images, not with --series", option));
  SeriesOptions series;
  series.name = options.series;
  series.scene = options.images.front();
  series.output = options.output;
  series.title = options.title;
  series.exposure = options.exposure;
  series.spp = options.spp;
  SceneOptions size;
  size.resolution = options.resolution;
  resolveResolution(size);
  series.width = size.width;
  series.height = size.height;
  makeSeries(series);
}

}  // namespace

Action addFigureVerb(CLI::App& app) {
  auto options = std::make_shared<FigureOptions>();
  CLI::App* verb = app.add_subcommand(
      "figure", "a paper's crop strip with labels and errors, or a scene as a series of pictures");
  verb->add_option("-r,--ref", options->reference, "the reference, an EXR; without it: --series");
  verb->add_option("images", options->images, "EXR files, one column each; --series: a scene")
      ->required();
  verb->add_option("--crop", options->crops, "X,Y,W,H in pixels from the top left; one row each")
      ->take_all()
      ->allow_extra_args(false);
  verb->add_option("-o,--output", options->output, "*.svg (text stays text) or *.png")->required();
  verb->add_option("--labels", options->labels,
                   "comma-separated, one an image (default: what tells the files' names apart)");
  verb->add_option("--title", options->title,
                   "above the whole image, below a series (default: the scene)");
  verb->add_option("--metric", options->metric, "restlab list metrics (default mse)");
  verb->add_option(
          "--exposure", options->exposure,
          "factor on radiance (default: by the reference, as in the report; of a series: by its "
          "last picture)")
      ->transform(numberFrom(1e-12, 1e12));
  verb->add_option("--scale", options->scale, "output pixels a pixel of a crop")
      ->transform(wholeNumberFrom(1, kMaxScale));
  verb->add_flag("--crop-errors", options->cropErrors, "the error of each crop as well");
  verb->add_flag("--any-reference", options->anyReference,
                 "compare with a reference of another scene or setting");
  verb->add_option("--series", options->series,
                   "course: the lights alone, direct light, shadows, indirect light, transparency "
                   "and reflection");
  verb->add_option("--resolution", options->resolution,
                   "WxH pixels of each picture of a series (default: 320 wide)");
  verb->add_option("--spp", options->spp, "frames of each picture of a series (default 64)")
      ->transform(wholeNumberFrom(1, 1'000'000));
  return [options](Outcome&) {
    options->series.empty() ? makeFigure(*options) : makeFigureOfScene(*options);
  };
}

}  // namespace restlab
