#include "experiments/runner/suite/suite_baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/base/error.h"
#include "core/radiance_cache/settings.h"

namespace restlab {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Rewrites every number in one form: 8, 8.0 and 0.8e1 are one setting.
std::string withPlainNumbers(const std::string& name) {
  std::string plain;
  for (size_t at = 0; at < name.size();) {
    const bool begins =
        isDigit(name[at]) && (at == 0 || name[at - 1] == '=' || name[at - 1] == '-');
    if (!begins) {
      plain += name[at++];
      continue;
    }
    char* end = nullptr;
    const double value = std::strtod(name.c_str() + at, &end);
    plain += fmt::format("{:.17g}", value);
    at = size_t(end - name.c_str());
  }
  return plain;
}

}  // namespace

void followBaseline(const ConfigTable& settings, Suite& suite) {
  if (suite.baseline.empty()) return;
  std::vector<std::string> names;
  const std::string wanted = withPlainNumbers(suite.baseline);
  std::string same;
  for (const SuiteMethod& method : suite.rendered()) {
    if (method.name == suite.baseline || method.base == suite.baseline) return;
    if (withPlainNumbers(method.name) == wanted) same = method.name;
    if (same.empty() && withPlainNumbers(method.base) == wanted) same = method.base;
    names.push_back(method.name);
  }
  if (!same.empty()) {
    suite.baseline = same;
    return;
  }
  settings.fail(
      "baseline",
      fmt::format("no method that is rendered is named '{}' (there are: '{}'){}", suite.baseline,
                  fmt::join(names, "', '"), didYouMean(suite.baseline, names)));
}

size_t Suite::baselineOf(size_t method) const {
  if (baseline.empty()) return firstPath(method, "none");
  const std::span<const SuiteMethod> all = rendered();
  const auto find = [&](auto isIt) {
    const auto found = std::find_if(all.begin(), all.end(), isIt);
    return found == all.end() ? methods.size() : size_t(found - all.begin());
  };
  const size_t named = find([&](const SuiteMethod& other) { return other.name == baseline; });
  if (named < methods.size() || all.empty()) return named;
  const std::string& backend =
      (methods[method].images ? all.front() : methods[method]).session.backend;
  return find([&](const SuiteMethod& other) {
    return other.base == baseline && other.session.backend == backend;
  });
}

const SuiteMethod* Suite::referenceRow() const {
  for (const SuiteMethod& method : rendered())
    if (method.name == referenceMethod || method.base == referenceMethod) return &method;
  return nullptr;
}

size_t Suite::average(size_t method) const { return firstPath(method, "accumulate"); }

size_t Suite::firstPath(size_t method, const std::string& denoiser) const {
  const std::span<const SuiteMethod> all = rendered();
  const std::string& backend =
      (methods[method].images ? all.front() : methods[method]).session.backend;
  const auto first = std::find_if(all.begin(), all.end(), [&](const SuiteMethod& other) {
    const SessionConfig& session = other.session;
    return session.integrator == "path" && session.denoiser == denoiser &&
           session.backend == backend && !endsPaths(other.parameters());
  });
  return first == all.end() ? methods.size() : size_t(first - all.begin());
}

std::string Suite::nameOfAll(size_t (Suite::*of)(size_t) const) const {
  std::set<std::string> names, bases;
  for (size_t m = 0; m < methods.size(); ++m) {
    const size_t found = (this->*of)(m);
    if (found >= methods.size()) continue;
    names.insert(methods[found].name);
    bases.insert(methods[found].base);
  }
  if (names.size() < 2) return names.empty() ? "" : *names.begin();
  return fmt::format("{} on the same backend", fmt::join(bases, " or "));
}

std::string Suite::baselineName() const { return nameOfAll(&Suite::baselineOf); }

std::string Suite::averageName() const { return nameOfAll(&Suite::average); }

size_t Suite::onFirstBackend(size_t method) const {
  const SuiteMethod& own = methods[method];
  if (own.images) return method;
  const auto first = std::find_if(methods.begin(), methods.end(), [&](const SuiteMethod& other) {
    const SessionConfig &a = own.session, &b = other.session;
    return own.base == other.base && a.integrator == b.integrator && a.mode == b.mode &&
           a.cache == b.cache && a.denoiser == b.denoiser && a.kernels == b.kernels &&
           a.parameters == b.parameters;
  });
  return size_t(first - methods.begin());
}

}  // namespace restlab
