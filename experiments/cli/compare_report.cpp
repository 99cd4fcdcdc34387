// Output of `restlab compare`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "experiments/cli/compare.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

// Warns with the reason of a NaN, logs how ambiguous metrics were computed, and shows other details
// only with -v.
void logDetailOf(const std::string& file, const std::string& metric, const MetricValue& value) {
  if (value.detail.empty()) return;
  const std::string line = fmt::format("{}: {}: {}", file, metric, value.detail);
  if (std::isnan(value.value)) {
    logWarning(line);
  } else if (findMetric(metric).readsNeighbours || metric == "max_err") {
    logInfo(line);
  } else {
    logDetail(line);
  }
}

std::string maskText(const Comparison& comparison) {
  const size_t pixels = comparison.reference.mean.pixels.size();
  return fmt::format("{} of {} pixels: {}", countSelected(comparison.mask.mask, pixels), pixels,
                     comparison.mask.text);
}

}  // namespace

void printTable(const Comparison& comparison) {
  const std::vector<std::string>& metrics = comparison.metrics;
  size_t width = std::strlen("image");
  for (const ComparedImage& one : comparison.images) width = std::max(width, one.file.size());
  print("{:<{}}", "image", width);
  for (const std::string& metric : metrics) print("  {:>14}", metric);
  print("\n");
  for (const ComparedImage& one : comparison.images) {
    print("{:<{}}", one.file, width);
    for (size_t i = 0; i < metrics.size(); ++i) {
      print("  {:>{}.6g}", one.values[i].value, std::max<size_t>(14, metrics[i].size()));
    }
    print("\n");
    for (size_t i = 0; i < metrics.size(); ++i) logDetailOf(one.file, metrics[i], one.values[i]);
  }
  if (comparison.runs) {
    print("bias_rms of the {} images as independent runs: {:.6g} ({})\n", comparison.runs->count,
          comparison.runs->biasRms.value, comparison.runs->biasRms.detail);
  }
  if (!comparison.mask.text.empty()) logInfo("mask: " + maskText(comparison));
  const Reference& reference = comparison.reference;
  if (reference.half0) {
    logInfo(
        fmt::format("reference: {} spp, its own relMSE {:.3g}", reference.spp, reference.relmse));
  }
}

void printJson(const Comparison& comparison, const CompareOptions& options) {
  const Reference& reference = comparison.reference;
  Json json = {{"reference", options.reference},
               {"reference_spp", reference.spp},
               {"reference_relmse", finite(reference.relmse)},
               {"reference_has_halves", reference.half0.has_value()},
               {"reference_nonfinite", comparison.referenceNonfinite}};
  if (!comparison.mask.text.empty()) {
    json["mask"] = {{"pixels", countSelected(comparison.mask.mask, reference.mean.pixels.size())},
                    {"selects", comparison.mask.text}};
  }
  json["images"] = Json::array();
  for (const ComparedImage& one : comparison.images) {
    Json values = Json::object(), details = Json::object();
    for (size_t i = 0; i < comparison.metrics.size(); ++i) {
      values[comparison.metrics[i]] = finite(one.values[i].value);
      if (!one.values[i].detail.empty()) details[comparison.metrics[i]] = one.values[i].detail;
    }
    json["images"].push_back({{"file", one.file},
                              {"nonfinite", one.nonfinite},
                              {"metrics", values},
                              {"details", details}});
  }
  if (comparison.runs) {
    const ComparedRuns& runs = *comparison.runs;
    json["runs"] = {{"count", runs.count},
                    {"metrics", {{"bias_rms", finite(runs.biasRms.value)}}},
                    {"squared_bias", finite(runs.squaredBias.value)},
                    {"squared_bias_ci_lo", finite(runs.squaredBias.lo)},
                    {"squared_bias_ci_hi", finite(runs.squaredBias.hi)},
                    {"details", {{"bias_rms", runs.biasRms.detail}}}};
  }
  printJsonText(json.dump(2));
}

}  // namespace restlab
