// restlab compare: errors of images against a reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/cli/against_reference.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/log.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

struct CompareOptions {
  std::string reference, metrics;
  std::vector<std::string> images, expectations;
  bool json = false, anyReference = false;
};

// "mse<0.01": a bound that fails the comparison (exit code 1).
struct Expectation {
  std::string text, metric, relation;
  double bound = 0.0;
  bool holds(double value) const {
    if (relation == "<") return value < bound;
    if (relation == "<=") return value <= bound;
    if (relation == ">") return value > bound;
    return value >= bound;
  }
};

Expectation parseExpectation(const std::string& text) {
  Expectation expectation;
  expectation.text = text;
  const size_t at = text.find_first_of("<>");
  if (at == std::string::npos || at == 0) {
    failUsage(fmt::format("--expect {}: must be METRIC<VALUE, with <, <=, > or >=", text));
  }
  const size_t length = at + 1 < text.size() && text[at + 1] == '=' ? 2 : 1;
  expectation.metric = findMetric(text.substr(0, at)).name;
  expectation.relation = text.substr(at, length);
  const std::string number = text.substr(at + length);
  char* end = nullptr;
  expectation.bound = std::strtod(number.c_str(), &end);
  if (number.empty() || *end != '\0' || std::isnan(expectation.bound)) {
    failUsage(fmt::format("--expect {}: '{}' is not a number", text, number));
  }
  return expectation;
}

Json finite(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

struct Compared {
  std::string file;
  size_t nonfinite = 0;
  std::vector<MetricValue> values;
};

Compared compareOne(const std::string& file, const CompareOptions& options,
                    const Reference& reference, const std::vector<std::string>& metrics) {
  const Image image = readBeside(file, options.reference, reference, options.anyReference);
  Compared compared;
  compared.file = file;
  compared.nonfinite = countNonfinite(image);
  for (const std::string& metric : metrics) {
    compared.values.push_back(errorAgainst(metric, image, reference));
  }
  return compared;
}

void printTable(const std::vector<Compared>& all, const std::vector<std::string>& metrics) {
  size_t width = std::strlen("image");
  for (const Compared& one : all) width = std::max(width, one.file.size());
  fmt::print("{:<{}}", "image", width);
  for (const std::string& metric : metrics) fmt::print("  {:>14}", metric);
  fmt::print("\n");
  for (const Compared& one : all) {
    fmt::print("{:<{}}", one.file, width);
    for (size_t i = 0; i < metrics.size(); ++i) {
      fmt::print("  {:>{}.6g}", one.values[i].value, std::max<size_t>(14, metrics[i].size()));
    }
    fmt::print("\n");
    for (size_t i = 0; i < metrics.size(); ++i) {
      if (!one.values[i].detail.empty()) {
        logDetail(fmt::format("{}: {}: {}", one.file, metrics[i], one.values[i].detail));
      }
    }
  }
}

void printJson(const std::vector<Compared>& all, const std::vector<std::string>& metrics,
               const CompareOptions& options, const Reference& reference) {
  Json json = {{"reference", options.reference},
               {"reference_spp", reference.spp},
               {"reference_has_halves", reference.half0.has_value()},
               {"images", Json::array()}};
  for (const Compared& one : all) {
    Json values = Json::object(), details = Json::object();
    for (size_t i = 0; i < metrics.size(); ++i) {
      values[metrics[i]] = finite(one.values[i].value);
      if (!one.values[i].detail.empty()) details[metrics[i]] = one.values[i].detail;
    }
    json["images"].push_back({{"file", one.file},
                              {"nonfinite", one.nonfinite},
                              {"metrics", values},
                              {"details", details}});
  }
  fmt::print("{}\n", json.dump(2));
}

// Exit code 1 and a line for each image that holds non-finite values or breaks a bound.
ExitCode judge(const std::vector<Compared>& all, const std::vector<std::string>& metrics,
               const std::vector<Expectation>& expectations) {
  ExitCode code = ExitCode::ok;
  for (const Compared& one : all) {
    if (one.nonfinite) {
      logError(fmt::format("{}: holds {} non-finite values", one.file, one.nonfinite));
      code = ExitCode::comparisonFailed;
    }
    for (const Expectation& expectation : expectations) {
      const auto at = std::find(metrics.begin(), metrics.end(), expectation.metric);
      const double value = one.values[size_t(at - metrics.begin())].value;
      if (expectation.holds(value)) continue;
      logError(fmt::format("{}: {} is {:.6g}, expected {}", one.file, expectation.metric, value,
                           expectation.text));
      code = ExitCode::comparisonFailed;
    }
  }
  return code;
}

void compare(const CompareOptions& options, Outcome& outcome) {
  std::vector<std::string> metrics = {"mse", "relmse_e1e-2", "mape_e1e-2", "energy_ratio"};
  if (!options.metrics.empty()) {
    metrics = options.metrics == "all" ? metricNames() : splitList(options.metrics, "--metrics");
  }
  std::vector<Expectation> expectations;
  for (const std::string& text : options.expectations) {
    expectations.push_back(parseExpectation(text));
    metrics.push_back(expectations.back().metric);
  }
  std::vector<std::string> unique;
  for (const std::string& metric : metrics) {
    const std::string& name = findMetric(metric).name;
    if (std::find(unique.begin(), unique.end(), name) == unique.end()) unique.push_back(name);
  }
  const Reference reference = readReference(options.reference);
  warnOfNoReference(options.reference, reference);
  std::vector<Compared> all;
  for (const std::string& file : options.images) {
    all.push_back(compareOne(file, options, reference, unique));
  }
  if (options.json) {
    printJson(all, unique, options, reference);
  } else {
    printTable(all, unique);
  }
  outcome.code = judge(all, unique, expectations);
}

}  // namespace

Action addCompareVerb(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* verb = app.add_subcommand("compare", "errors of images against a reference");
  verb->add_option("-r,--ref", options->reference, "the reference, an EXR")->required();
  verb->add_option("images", options->images, "EXR files")->required();
  verb->add_option("--metrics", options->metrics,
                   "comma-separated names, or all (restlab list metrics)");
  verb->add_option("--expect", options->expectations,
                   "METRIC<VALUE (or <=, >, >=); exit code 1 where it does not hold")
      ->take_all()
      ->allow_extra_args(false);
  verb->add_flag("--any-reference", options->anyReference,
                 "compare with a reference of another scene or setting");
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options](Outcome& outcome) { compare(*options, outcome); };
}

}  // namespace restlab
