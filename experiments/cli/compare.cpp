// restlab compare: errors of images against a reference.
#include "experiments/cli/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "core/image/metrics/pixel_metrics.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/compare/compare_folders.h"
#include "experiments/runner/reference/beside_reference.h"
#include "experiments/runner/reference/reference_error.h"

namespace restlab {

namespace {

constexpr const char* kFailIfWorse = "--fail-if-worse";

// Includes metrics that need several runs: they are computed over all images together.
std::vector<std::string> chosenMetrics(const CompareOptions& options,
                                       const std::vector<Expectation>& expectations) {
  std::vector<std::string> metrics = {"mse", "relmse_e1e-2", "mape_e1e-2", "energy_ratio"};
  if (options.metrics == "all") {
    metrics.clear();
    for (const MetricInfo& metric : metricRegistry()) {
      if (!metric.needsRuns) metrics.push_back(metric.name);
    }
  } else if (!options.metrics.empty()) {
    metrics = splitList(options.metrics, "--metrics");
  }
  if (!options.conventions.empty()) {
    const std::vector<std::string>& known = relmseConventions();
    for (const std::string& name : splitList(options.conventions, "--relmse-convention")) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        failUsage(fmt::format("--relmse-convention {}: unknown (known: {}){}", name,
                              fmt::join(known, ", "), didYouMean(name, known)));
      }
      metrics.push_back("relmse_" + name);
    }
  }
  for (const Expectation& expectation : expectations) metrics.push_back(expectation.metric);
  std::vector<std::string> unique;
  for (const std::string& metric : metrics) {
    const std::string& name = findMetric(metric).name;
    if (std::find(unique.begin(), unique.end(), name) == unique.end()) unique.push_back(name);
  }
  return unique;
}

FlipOptions flipOptions(const CompareOptions& options) {
  FlipOptions flip;
  flip.pixelsPerDegree = options.pixelsPerDegree;
  if (options.flipExposures.empty()) return flip;
  const std::vector<std::string> parts = splitList(options.flipExposures, "--flip-exposures");
  double numbers[3] = {};
  bool isGood = parts.size() == 3;
  for (size_t i = 0; isGood && i < 3; ++i) {
    const char* end = parts[i].data() + parts[i].size();
    const auto [rest, status] = std::from_chars(parts[i].data(), end, numbers[i]);
    isGood = status == std::errc() && rest == end;
  }
  isGood = isGood && numbers[2] >= 1.0 && numbers[2] <= kFlipMaxExposures &&
           numbers[2] == std::floor(numbers[2]);
  if (!isGood) {
    failUsage(fmt::format("--flip-exposures {}: must be START,STOP,COUNT: stops, and 1 to {}",
                          options.flipExposures, kFlipMaxExposures));
  }
  flip.exposures = FlipExposures{numbers[0], numbers[1], uint32_t(numbers[2])};
  return flip;
}

void compare(const CompareOptions& options, Outcome& outcome) {
  std::vector<Expectation> expectations;
  for (const std::string& text : options.expectations) {
    expectations.push_back(parseExpectation(text));
  }
  for (const std::string& text : options.maxima) expectations.push_back(parseMaximum(text));
  Comparison comparison;
  bool needsRuns = false;
  for (const std::string& name : chosenMetrics(options, expectations)) {
    if (!findMetric(name).needsRuns) {
      comparison.metrics.push_back(name);
    } else if (options.images.size() < 2) {
      failUsage(fmt::format("{}: needs two images or more, independent runs of one method", name));
    } else {
      needsRuns = true;
    }
  }
  MetricOptions metricOptions;
  metricOptions.flip = flipOptions(options);
  requireFlipOptions(metricOptions.flip);

  comparison.reference = readReference(options.reference);
  const Reference& reference = comparison.reference;
  comparison.referenceFile = options.reference;
  comparison.referenceNonfinite = countNonfinite(reference.mean);
  for (const std::optional<Image>* half : {&reference.half0, &reference.half1})
    if (*half) comparison.referenceNonfinite += countNonfinite(**half);
  warnOfNoReference(options.reference, reference);
  comparison.mask = chooseMask(options, reference);
  metricOptions.mask = comparison.mask.mask;
  ComparedMethod runs;
  for (const std::string& file : options.images) {
    const LayeredImage read = readBeside(file, options.reference, reference, options.anyReference);
    const Image& image = read.layers.at("");
    if (needsRuns) runs.add(file, read);
    ComparedImage compared{file, countNonfinite(image), {}};
    for (const std::string& metric : comparison.metrics) {
      compared.values.push_back(errorAgainst(metric, image, reference, metricOptions));
    }
    comparison.images.push_back(std::move(compared));
  }
  if (needsRuns) comparison.runs = runs.bias(reference, metricOptions.mask);
  if (options.json) {
    printJson(comparison, options);
  } else {
    printTable(comparison);
  }
  outcome.code = judge(comparison, expectations);
}

void addMetricOptions(CLI::App& verb, CompareOptions& options) {
  verb.add_option("--metrics", options.metrics,
                  "comma-separated names (restlab list metrics), or all that a single image has; "
                  "FLIP takes seconds; bias_rms takes the images as independent runs");
  verb.add_option("--relmse-convention", options.conventions,
                  "also the relative MSE as others compute it: pbrt, tev, jeri, siio, mean2");
  verb.add_option("--ppd", options.pixelsPerDegree,
                  "of FLIP: pixels per degree of the viewer's field (default 67.0206)")
      ->transform(numberFrom(kFlipMinPixelsPerDegree, kFlipMaxPixelsPerDegree));
  verb.add_option("--flip-exposures", options.flipExposures,
                  "of flip_hdr: START,STOP,COUNT in stops (default: from the reference)");
}

void addBoundOptions(CLI::App& verb, CompareOptions& options) {
  verb.add_option("--max", options.maxima,
                  "METRIC=VALUE: exit code 1 where an image has more, or NaN")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--expect", options.expectations,
                  "METRIC<VALUE (or <=, >, >=); exit code 1 where it does not hold")
      ->take_all()
      ->allow_extra_args(false);
}

void addMaskOptions(CLI::App& verb, CompareOptions& options) {
  verb.add_option("--rect", options.rectangles,
                  "X0,Y0,X1,Y1: only the pixels X0 <= x < X1, Y0 <= y < Y1; several are united")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--object", options.objects,
                  "name or number (--aov object): only pixels whose centre shows it; several are "
                  "united")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_flag("--without-lights", options.withoutLights,
                "only pixels that see no light or environment directly");
  verb.add_option("--mask", options.maskFile, "EXR: only pixels where it is not 0");
}

// Rejects options for images, which would be ignored for folders.
void refuseImageOptions(const CLI::App& verb) {
  const std::vector<std::string> known = {"images",  "--json",    kFailIfWorse,
                                          "--quiet", "--verbose", "--help"};
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::find(known.begin(), known.end(), name) != known.end())
      continue;
    failUsage(fmt::format("compare: {} is for images beside --ref; two folders take --json and {}",
                          name, kFailIfWorse));
  }
}

void requireTwoFolders(const std::vector<std::string>& folders) {
  const bool areFolders = std::all_of(folders.begin(), folders.end(), [](const std::string& name) {
    std::error_code status;
    return std::filesystem::is_directory(name, status);
  });
  for (const std::string& name : folders) {
    std::error_code status;
    if (folders.size() == 2 && !std::filesystem::exists(name, status))
      failInput(fmt::format("compare: {}: there is no such file or folder", name));
  }
  if (!areFolders) failUsage("compare: images need --ref, the reference they are compared with");
  if (folders.size() != 2)
    failUsage(fmt::format("compare: takes two folders of results, not {}", folders.size()));
}

// Compares two folders, instead of images with a reference.
void compareResults(const CLI::App& verb, const CompareOptions& options, Outcome& outcome) {
  requireTwoFolders(options.images);
  refuseImageOptions(verb);
  const FolderComparison comparison = compareFolders(options.images[0], options.images[1]);
  if (options.json) {
    printJsonText(comparisonJson(comparison).dump(2));
  } else {
    printText(comparisonTable(comparison));
  }
  if (!options.failIfWorse) return;
  for (const ComparedRow& row : comparison.rows) {
    if (!row.isWorse()) continue;
    logError(fmt::format("{}, {}: {} is worse", row.table, row.method,
                         row.error != Verdict::worse  ? "the time"
                         : row.time != Verdict::worse ? "the MSE"
                                                      : "the MSE and the time"));
    outcome.code = ExitCode::comparisonFailed;
  }
}

}  // namespace

Action addCompareVerb(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* verb = app.add_subcommand(
      "compare", "errors of images against a reference, or two folders of `run`");
  verb->add_option("-r,--ref", options->reference, "the reference, an EXR");
  verb->add_option("images", options->images,
                   "EXR files; or two folders that `run` left, the older first")
      ->required();
  addMetricOptions(*verb, *options);
  addMaskOptions(*verb, *options);
  addBoundOptions(*verb, *options);
  verb->add_flag("--any-reference", options->anyReference,
                 "compare with a reference of another scene or setting");
  verb->add_flag(kFailIfWorse, options->failIfWorse,
                 "of two folders: exit code 1 where the MSE or the time of a row is worse");
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options, verb](Outcome& outcome) {
    if (options->reference.empty()) return compareResults(*verb, *options, outcome);
    if (options->failIfWorse)
      failUsage(fmt::format("compare: {} is for two folders; images take --max and --expect",
                            kFailIfWorse));
    compare(*options, outcome);
  };
}

}  // namespace restlab
