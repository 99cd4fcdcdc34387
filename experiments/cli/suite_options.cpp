#include "experiments/cli/suite_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/scene/scene.h"
#include "core/scene/scene_file/scene_file.h"
#include "experiments/cli/options.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"

namespace restlab {

namespace {

// Includes the common name of a sweep's scenes.
std::vector<std::string> namesOf(const SuiteScene& scene) {
  if (scene.sweepName.empty()) return {scene.name};
  return {scene.name, scene.sweepName};
}
std::vector<std::string> namesOf(const SuiteMethod& method) {
  return {method.name, method.base, method.given};
}

// Keeps the items with a name in the comma-separated list, or equal to the whole list: names of
// swept items have commas.
template <class Item>
void keepNamed(std::vector<Item>& items, const std::string& list, const std::string& option) {
  if (list.empty()) return;
  std::vector<std::string> names, shown;
  for (const Item& item : items) {
    shown.push_back(item.name);
    for (const std::string& name : namesOf(item)) names.push_back(name);
  }
  const bool isOne = std::find(names.begin(), names.end(), list) != names.end();
  const std::vector<std::string> wanted =
      isOne ? std::vector<std::string>{list} : splitList(list, option);
  for (const std::string& name : wanted) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    failUsage(fmt::format("{} {}: not in the suite (it has: '{}'){}", option, name,
                          fmt::join(shown, "', '"), didYouMean(name, names)));
  }
  std::erase_if(items, [&](const Item& item) {
    const std::vector<std::string> own = namesOf(item);
    return std::none_of(own.begin(), own.end(), [&](const std::string& name) {
      return std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    });
  });
}

void warnOfBaselines(const Suite& suite) {
  if (!suite.baseline.empty()) {
    if (suite.baselineOf(0) == suite.methods.size())
      failUsage(fmt::format("--methods leaves out '{}', the baseline", suite.baseline));
    return;
  }
  for (const std::string& backend : suite.methodBackends()) {
    const auto first =
        std::find_if(suite.methods.begin(), suite.methods.end(),
                     [&](const SuiteMethod& method) { return method.session.backend == backend; });
    if (suite.baselineOf(size_t(first - suite.methods.begin())) < suite.methods.size()) continue;
    logWarning(
        fmt::format("the suite has no method with integrator = \"path\" on {}: there is nothing to "
                    "compare with, ratios are nan",
                    backend));
  }
}

void warnOfParameters(const std::vector<Suite>& points) {
  std::set<std::string> said;
  for (const Suite& suite : points) {
    for (const SuiteMethod& method : suite.rendered()) {
      const Method parts = findMethod(method.session);
      for (const auto& [name, why] :
           settingsWithoutEffect(parts, method.session.mode, method.session.parameters)) {
        const std::string line =
            fmt::format("method '{}': {} has no effect: {}", method.name, name, why);
        if (said.insert(line).second) logWarning(line);
      }
    }
  }
}

// Refers users who name a scene to `render`.
void refuseScene(const std::string& verb, const std::string& name) {
  const std::string file = splitSceneSettings(name).first;
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension != ".gltf" && extension != ".glb" && extension != ".xml" && !isSceneFile(file) &&
      (!isBuiltinScene(name) || std::filesystem::exists(name) || findSuite(name) != name))
    return;
  failUsage(
      fmt::format("{0} {1}: is a scene, and {0} takes a suite of scenes and methods (*.toml); "
                  "restlab render {1} -o image.exr renders it",
                  verb, name));
}

}  // namespace

void addSuiteOptions(CLI::App& verb, SuiteOptions& options) {
  verb.add_option("suite", options.suite,
                  "a TOML file (experiments/suites has some), or the name of an installed one")
      ->required();
  verb.add_option("-o,--out", options.out, "folder of the results (default results/NAME)");
  verb.add_option("--set", options.overrides,
                  "KEY=VALUE: a setting, reference.KEY, method.KEY or method.NAME.KEY")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--sweep", options.sweeps,
                  "KEY=VALUES: a setting, or something of methods, with a,b,c or 1..8")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--scenes", options.scenes, "only these scenes of the suite, comma-separated");
  verb.add_option("--methods", options.methods, "only these methods, comma-separated");
  addThreads(verb, options.threads);
}

std::vector<Suite> chosenSuites(const std::string& verb, const SuiteOptions& options) {
  refuseScene(verb, options.suite);
  std::vector<Suite> points = loadSuites(options.suite, options.overrides, options.sweeps);
  for (Suite& suite : points) {
    keepNamed(suite.scenes, options.scenes, "--scenes");
    keepNamed(suite.methods, options.methods, "--methods");
    if (suite.rendered().empty())
      failUsage(fmt::format("--methods {}: leaves no method that is rendered", options.methods));
    if (options.threads >= 0) suite.threads = options.threads;
  }
  if (points.front().minRuns() < 2) {
    logWarning("runs = 1: no interval and no bias can be given; biased rows will not count");
  }
  warnOfBaselines(points.front());
  warnOfParameters(points);
  return points;
}

std::filesystem::path outFolder(const SuiteOptions& options, const Suite& suite) {
  return options.out.empty() ? std::filesystem::path("results") / safeFileName(suite.name)
                             : std::filesystem::path(options.out);
}

void logChoice(const std::vector<Suite>& points, const std::filesystem::path& out) {
  const Suite& suite = points.front();
  const std::string runs = suite.minRuns() == suite.maxRuns()
                               ? counted(suite.maxRuns(), "run")
                               : fmt::format("{} to {} runs", suite.minRuns(), suite.maxRuns());
  logInfo(fmt::format("{}: {}{}, {}, {}; results in {}", suite.name,
                      points.size() > 1 ? counted(points.size(), "point") + ", " : "",
                      counted(suite.scenes.size(), "scene"),
                      counted(suite.methods.size(), "method"), runs, out.string()));
}

}  // namespace restlab
