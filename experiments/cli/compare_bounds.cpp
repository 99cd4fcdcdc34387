// Bounds on metrics, for scripts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "experiments/cli/compare.h"
#include "experiments/runner/base/log.h"

namespace restlab {

namespace {

double parseBound(const std::string& number, const std::string& place) {
  char* end = nullptr;
  const double bound = std::strtod(number.c_str(), &end);
  if (number.empty() || *end != '\0' || std::isnan(bound)) {
    failUsage(fmt::format("{}: '{}' is not a number", place, number));
  }
  return bound;
}

ExitCode judgeValue(const std::string& what, double value, const Expectation& expectation) {
  if (expectation.holds(value)) return ExitCode::ok;
  logError(fmt::format("{}: {} is {:.6g}, expected {}", what, expectation.metric, value,
                       expectation.text));
  return ExitCode::comparisonFailed;
}

}  // namespace

bool Expectation::holds(double value) const {
  if (relation == "<") return value < bound;
  if (relation == "<=") return value <= bound;
  if (relation == ">") return value > bound;
  return value >= bound;
}

Expectation parseExpectation(const std::string& text) {
  const size_t at = text.find_first_of("<>");
  if (at == std::string::npos || at == 0) {
    failUsage(fmt::format("--expect {}: must be METRIC<VALUE, with <, <=, > or >=", text));
  }
  const size_t length = at + 1 < text.size() && text[at + 1] == '=' ? 2 : 1;
  return {text, findMetric(text.substr(0, at)).name, text.substr(at, length),
          parseBound(text.substr(at + length), "--expect " + text)};
}

Expectation parseMaximum(const std::string& text) {
  const size_t at = text.find('=');
  if (at == std::string::npos || at == 0) {
    failUsage(fmt::format("--max {}: must be METRIC=VALUE, for example mse=0.01", text));
  }
  const std::string metric = findMetric(text.substr(0, at)).name, number = text.substr(at + 1);
  return {metric + "<=" + number, metric, "<=", parseBound(number, "--max " + text)};
}

ExitCode judge(const Comparison& comparison, const std::vector<Expectation>& expectations) {
  ExitCode code = ExitCode::ok;
  const auto worse = [&code](ExitCode other) { code = std::max(code, other); };
  if (comparison.referenceNonfinite) {
    logError(fmt::format("{}: the reference holds {} non-finite values", comparison.referenceFile,
                         comparison.referenceNonfinite));
    worse(ExitCode::comparisonFailed);
  }
  for (const ComparedImage& image : comparison.images) {
    if (image.nonfinite) {
      logError(fmt::format("{}: holds {} non-finite values", image.file, image.nonfinite));
      worse(ExitCode::comparisonFailed);
    }
    for (const Expectation& expectation : expectations) {
      const auto& names = comparison.metrics;
      const auto at = std::find(names.begin(), names.end(), expectation.metric);
      if (at == names.end()) continue;  // computed over all images together
      worse(judgeValue(image.file, image.values[size_t(at - names.begin())].value, expectation));
    }
  }
  for (const Expectation& expectation : expectations) {
    if (!findMetric(expectation.metric).needsRuns) continue;
    const ComparedRuns& runs = *comparison.runs;
    worse(judgeValue(fmt::format("the {} runs", runs.count), runs.biasRms.value, expectation));
  }
  return code;
}

}  // namespace restlab
