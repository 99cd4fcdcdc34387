#include "experiments/runner/suite/suite_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/backend/backend.h"
#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/image/metrics/metrics.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

void addMetric(const ConfigTable& settings, const std::string& given,
               std::vector<std::string>& metrics) {
  const std::vector<std::string> known = metricNames();
  if (std::find(known.begin(), known.end(), given) == known.end()) {
    settings.fail("metrics", fmt::format("unknown metric '{}' (restlab list metrics){}", given,
                                         didYouMean(given, known)));
  }
  if (findMetric(given).needsRuns)
    settings.fail("metrics", fmt::format("'{}' is of several runs: see bias_squared", given));
  if (std::find(metrics.begin(), metrics.end(), given) != metrics.end())
    settings.fail("metrics", fmt::format("'metrics' holds '{}' twice", given));
  metrics.push_back(given);
}

}  // namespace

std::vector<std::string> readBackends(const ConfigTable& table,
                                      const std::vector<std::string>& fallback) {
  const std::vector<std::string> given = table.getStrings("backend", fallback);
  const std::vector<std::string>& known = backendNames();
  for (size_t i = 0; i < given.size(); ++i) {
    if (std::find(known.begin(), known.end(), given[i]) == known.end()) {
      table.fail("backend", fmt::format("unknown backend '{}' (known: {}){}", given[i],
                                        fmt::join(known, ", "), didYouMean(given[i], known)));
    }
    if (std::find(given.begin(), given.begin() + std::ptrdiff_t(i), given[i]) !=
        given.begin() + std::ptrdiff_t(i))
      table.fail("backend", fmt::format("'backend' holds '{}' twice", given[i]));
  }
  if (given.empty()) table.fail("backend", "'backend' is empty");
  return given;
}

void readMasks(const ConfigTable& root, Suite& suite) {
  for (const ConfigTable& table : root.getTables("mask")) {
    SuiteMask mask;
    mask.place = table.place("");
    mask.objectsPlace = table.place("objects");
    mask.rectanglePlace = table.place("rectangle");
    mask.name = table.getString("name", "");
    mask.scene = table.getString("scene", "");
    mask.objects = table.getStrings("objects", {});
    mask.withoutLights = table.getBool("without_lights", false);
    if (table.has("rectangle")) {
      const std::vector<int64_t> sides = table.getIntegers("rectangle", {}, 0, kMaxSide);
      if (sides.size() != 4) {
        table.fail("rectangle",
                   "'rectangle' must be [X0, Y0, X1, Y1], from the upper left corner of the image");
      }
      mask.rectangles = {
          {uint32_t(sides[0]), uint32_t(sides[1]), uint32_t(sides[2]), uint32_t(sides[3])}};
    }
    table.finish();
    if (mask.name.empty()) table.fail("name", "[[mask]] needs a 'name'");
    for (const SuiteMask& other : suite.masks) {
      if (other.name == mask.name)
        table.fail("name", fmt::format("two masks are named '{}'", mask.name));
    }
    if (mask.objects.empty() && mask.rectangles.empty() && !mask.withoutLights)
      table.fail("", "[[mask]] needs 'objects', 'rectangle' or 'without_lights'");
    std::vector<std::string> scenes;
    for (const SuiteScene& scene : suite.scenes) scenes.push_back(scene.name);
    if (!mask.scene.empty() &&
        std::find(scenes.begin(), scenes.end(), mask.scene) == scenes.end()) {
      table.fail("scene", fmt::format("the suite has no scene named '{}'{}", mask.scene,
                                      didYouMean(mask.scene, scenes)));
    }
    suite.masks.push_back(std::move(mask));
  }
}

namespace {

// Lets a size from the command line or a sweep replace that of the file, also in the other
// notation.
void readSize(const ConfigTable& table, const std::set<std::string>& swept, Suite& suite) {
  const auto isLater = [&](const std::string& key) {
    return table.has(key) && (swept.count(key) > 0 || table.place(key).rfind("--", 0) == 0);
  };
  const bool laterSides = isLater("width") || isLater("height");
  const bool laterResolution = isLater("resolution");
  const bool bothOfOne = laterSides == laterResolution;
  const uint32_t width = uint32_t(table.getInteger("width", 0, 1, kMaxSide));
  const uint32_t height = uint32_t(table.getInteger("height", 0, 1, kMaxSide));
  const bool hasSides = width || height;
  if (table.has("resolution") && hasSides && bothOfOne)
    table.fail("resolution", "'resolution' and 'width' or 'height' exclude each other");
  if (table.has("resolution") && !(hasSides && laterSides)) {
    parseResolution(table.getString("resolution", ""), table.place("resolution") + ": 'resolution'",
                    suite.width, suite.height);
    return;
  }
  suite.width = width;
  suite.height = height;
}

}  // namespace

ParameterMap readTransport(const ConfigTable& table) {
  ParameterMap given;
  for (const ParameterInfo& info : transportSchema().infos())
    if (const auto value = table.getParameter(info)) given[info.name] = *value;
  return given;
}

void readSettings(const ConfigTable& table, Suite& suite, const std::set<std::string>& swept) {
  readSize(table, swept, suite);
  transportSchema().assign(suite, readTransport(table));
  suite.warmupFrames =
      uint32_t(table.getInteger("warmup_frames", suite.warmupFrames, 0, kMaxCount));
  suite.timedFrames = uint32_t(table.getInteger("frames", suite.timedFrames, 1, kMaxCount));
  suite.runs = uint32_t(table.getInteger("runs", suite.runs, 1, kMaxCount));
  suite.seed = uint32_t(table.getInteger("seed", suite.seed, 0, 0x7fffffff));
  suite.threads = int(table.getInteger("threads", suite.threads, 0, 1024));
  suite.backends = readBackends(table, suite.backends);
  suite.device = table.getString("device", "");
  suite.devicePlace = table.place("device");
  suite.rayTracingPlace = table.place("ray_tracing");
  if (table.has("ray_tracing")) {
    suite.rayTracing = table.getChoice("ray_tracing", rayTracingNames().front(), rayTracingNames());
  }
  suite.validate = table.getBool("validate", suite.validate);
  suite.cameraPathName = table.getString("camera_path", suite.cameraPathName);
  suite.cameraPathPlace = table.place("camera_path");
  suite.accumulate = table.getBool("accumulate", suite.accumulate);
  suite.temporal = table.getBool("temporal", suite.temporal);
  suite.timing = table.getBool("timing", suite.timing);
  suite.holdsWithin = table.getNumber("holds_within", suite.holdsWithin, 0.0, 1.0);
  suite.failOnNonfinite = table.getBool("fail_on_nonfinite", suite.failOnNonfinite);
  suite.failOnEnergy = table.getBool("fail_on_energy", suite.failOnEnergy);
  suite.baseline = table.getString("baseline", suite.baseline);
  for (const std::string& given : table.getStrings("metrics", {}))
    addMetric(table, given, suite.metrics);
  suite.components.clear();
  for (const std::string& name : table.getStrings("components", {"all"})) {
    const uint32_t component = parseComponent(name, table.place("components"));
    if (std::find(suite.components.begin(), suite.components.end(), component) !=
        suite.components.end()) {
      table.fail("components", fmt::format("'components' holds '{}' twice", name));
    }
    suite.components.push_back(component);
  }
  if (suite.components.empty()) table.fail("components", "'components' is empty");
  for (const int64_t age : table.getIntegers("ages", {}, 1, kMaxCount)) {
    if (!suite.ages.empty() && suite.ages.back() >= age) {
      table.fail("ages", fmt::format("'ages' has {} after {}: they stand in order, each once", age,
                                     suite.ages.back()));
    }
    suite.ages.push_back(uint32_t(age));
  }
  table.finish();
}

void readPaths(const ConfigTable& root, Suite& suite) {
  suite.paths = {{"still", {}, {}}};
  for (const ConfigTable& table : root.getTables("camera_path")) {
    const std::string name = table.getString("name", "");
    if (name.empty()) table.fail("name", "[[camera_path]] needs a 'name'");
    const bool isTaken = std::any_of(suite.paths.begin(), suite.paths.end(),
                                     [&](const SuitePath& path) { return path.name == name; });
    if (isTaken) table.fail("name", fmt::format("two camera paths are named '{}'", name));
    suite.paths.push_back({name, parseCameraPath(table), {}});
  }
  readLightEvents(root, suite.paths);
}

void takePath(Suite& suite, const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const SuitePath& path : suite.paths) {
    names.push_back(path.name);
    if (path.name != name) continue;
    suite.cameraPathName = name;
    suite.cameraPathPlace = place;
    suite.cameraPath = path.camera;
    suite.events = path.events;
    return;
  }
  failUsage(
      fmt::format("{}: no [[camera_path]] is named '{}'{}", place, name, didYouMean(name, names)));
}

void checkPath(const ConfigTable& settings, const Suite& suite) {
  checkLightEvents(settings, suite);
  const uint32_t length = suite.warmupFrames + suite.timedFrames;
  // The only reference is of the measured frame's camera.
  const std::optional<uint32_t> still = firstStillFrame(suite.cameraPath);
  if (!suite.ages.empty() && (!still || *still > suite.warmupFrames)) {
    settings.fail("ages", fmt::format("'ages' count the frames of a view that stands still; on the "
                                      "path '{}' {}",
                                      suite.cameraPathName,
                                      still ? "the cut comes after the measured frame"
                                            : "each would need a reference"));
  }
  if (!suite.ages.empty() && suite.frameOfAge(suite.ages.back()) >= length) {
    settings.fail("ages",
                  fmt::format("'ages' has {}, which is frame {}, but a run ends at frame {}",
                              suite.ages.back(), suite.frameOfAge(suite.ages.back()), length - 1));
  }
  if (!suite.hasMovingCamera()) return;
  if (suite.accumulate)
    settings.fail("accumulate", "'accumulate' is of a still camera: frames of a moving one differ");
}

const std::vector<std::string>& settingsKeys() {
  static const std::vector<std::string> keys = [] {
    const ConfigTable table = ConfigTable::parseText("", "settings");
    Suite suite;
    readSettings(table, suite);
    return table.known();
  }();
  return keys;
}

namespace {

// Rejects methods whose frames have no mean of their own: they depend on one another, or on a
// filter.
void requireReferenceMethod(const ConfigTable& table, const Suite& suite) {
  const SuiteMethod* method = suite.referenceRow();
  if (method == nullptr) {
    std::vector<std::string> names;
    for (const SuiteMethod& other : suite.rendered()) names.push_back(other.name);
    table.fail("method", fmt::format("'{}': the suite has no such method{}", suite.referenceMethod,
                                     didYouMean(suite.referenceMethod, names)));
  }
  if (method->session.denoiser != "none")
    table.fail("method", fmt::format("'{}': has a denoiser; a method without one would be right",
                                     method->name));
  const Method parts = findMethod(method->session);
  if (parts.hasHistory(resolveParameters(parts, method->parameters())))
    table.fail("method", fmt::format("'{}': its frames depend on earlier ones; a method without "
                                     "history would have a mean of its own",
                                     method->name));
}

}  // namespace

void readReference(const ConfigTable& table, Suite& suite) {
  suite.referenceBackend = table.getChoice("backend", suite.referenceBackend, backendNames());
  suite.referenceBackendPlace = table.place("backend");
  suite.referenceIntegrator =
      table.getChoice("integrator", suite.referenceIntegrator, referenceIntegrators());
  suite.referenceMethod = table.getString("method", "");
  if (!suite.referenceMethod.empty()) {
    if (!table.getString("integrator", "").empty())
      table.fail("method",
                 "'integrator' and 'method' both say who renders the reference; give one");
    requireReferenceMethod(table, suite);
  }
  ReferenceTarget& target = suite.target;
  target.spp = uint64_t(table.getInteger("spp", 0, 2, int64_t(1) << 32));
  target.relmse = table.getNumber("target_relmse", 0.0, 1e-12, 1e6);
  target.timeLimitS = table.getNumber("time_limit", 0.0, 1e-3, 1e9);
  if (target.spp == 0 && target.relmse == 0.0 && target.timeLimitS == 0.0) target.spp = 256;
  table.finish();
}

}  // namespace restlab
