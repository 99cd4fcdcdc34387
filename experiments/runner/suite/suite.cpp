#include "core/scene/scene_file/scene_file.h"
#include "experiments/runner/suite/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/radiance_cache/settings.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/suite/scene_parameter.h"
#include "experiments/runner/suite/suite_baseline.h"
#include "experiments/runner/suite/suite_methods.h"
#include "experiments/runner/suite/suite_overrides.h"
#include "experiments/runner/suite/suite_settings.h"
#include "experiments/runner/suite/sweep.h"

namespace restlab {

namespace {

// Returns a file's name without folder and extensions, with what follows its '?'.
std::string shownName(const std::string& scene) {
  if (isBuiltinScene(scene)) return scene;
  const auto [file, settings] = splitSceneSettings(scene);
  const std::filesystem::path stem = std::filesystem::path(file).stem();
  const std::string name = isSceneFile(file) ? stem.stem().string() : stem.string();
  return settings.empty() ? name : name + "?" + settings;
}

SuiteScene readScene(const ConfigTable& table, const std::string& folder) {
  SuiteScene scene;
  scene.request.suiteFolder = folder;
  if (table.has("camera")) scene.request.camera = readCameraName(table);
  scene.request.environment = table.getString("environment", "");
  if (table.has("environment_rotation")) {
    scene.request.environmentRotation = table.getNumber("environment_rotation", 0.0, -360.0, 360.0);
  }
  if (table.has("environment_scale")) {
    scene.request.environmentScale = table.getNumber("environment_scale", 1.0, 0.0, 1e9);
  }
  scene.name = table.getString("name", "");
  scene.reference = table.getString("reference", "");
  const std::vector<std::string> truths = {"rendered", "exact", "same"};
  const std::string truth = table.getChoice("truth", truths.front(), truths);
  scene.truth = truth == "exact" ? Truth::exact : truth == "same" ? Truth::same : Truth::rendered;
  if (scene.truth != Truth::rendered && !scene.reference.empty())
    table.fail("truth", "'truth' and 'reference' exclude each other");
  scene.transport = readTransport(table);
  if (table.has("warmup_frames"))
    scene.warmupFrames = uint32_t(table.getInteger("warmup_frames", 0, 0, kMaxCount));
  if (table.has("runs")) scene.runs = uint32_t(table.getInteger("runs", 1, 1, kMaxCount));
  if (table.has("camera_path")) scene.cameraPath = table.getString("camera_path", "");
  scene.place = table.place("scene");
  scene.cameraPlace = table.place("camera");
  scene.environmentPlace = table.place("environment");
  scene.referencePlace = table.place("reference");
  scene.truthPlace = table.place("truth");
  scene.cameraPathPlace = table.place("camera_path");
  scene.width = uint32_t(table.getInteger("width", 0, 1, kMaxSide));
  scene.height = uint32_t(table.getInteger("height", 0, 1, kMaxSide));
  scene.reverseTurns = table.getBool("reverse_turns", false);
  scene.optional = table.getBool("optional", false);
  return scene;
}

// Reads the scenes of a [[scene]]. Several scenes are a sweep: of one built-in, different in one
// parameter.
std::vector<SuiteScene> readScenes(const ConfigTable& table, const std::string& folder,
                                   size_t sweep) {
  const SuiteScene common = readScene(table, folder);
  const std::vector<std::string> names = table.getStrings("scene");
  table.finish();
  if (names.empty() || names.front().empty()) {
    table.fail("scene", "[[scene]] needs a key 'scene'");
  }
  std::vector<SuiteScene> scenes;
  for (const std::string& name : names) {
    SuiteScene& scene = scenes.emplace_back(common);
    scene.request.scene = name;
    if (names.size() == 1) {
      if (scene.name.empty()) scene.name = shownName(name);
      continue;
    }
    scene.sweep = sweep;
    scene.sweepName = common.name;
    scene.name = (common.name.empty() ? "" : common.name + ": ") + shownName(name);
  }
  if (names.size() > 1) {
    atPlace(table.place("scene"), [&] { return sweptParameter(names); });
  }
  return scenes;
}

// Adds the backend to every name in a table of several backends.
void nameByBackend(Suite& suite) {
  if (suite.methodBackends().size() < 2) return;
  for (SuiteMethod& method : suite.methods) {
    if (!method.images) method.name = fmt::format("{} @{}", method.base, method.session.backend);
  }
}

// Rejects a setting that no backend in use supports, instead of ignoring it.
void requireSomeUse(const ConfigTable& settings, const Suite& suite) {
  std::vector<std::string> used = suite.methodBackends();
  used.push_back(suite.referenceBackend);
  const bool vulkan = std::find(used.begin(), used.end(), "vulkan") != used.end();
  if (!vulkan && !suite.device.empty()) {
    settings.fail("device", fmt::format("'device' is '{}', but nothing runs on the backend vulkan",
                                        suite.device));
  }
  if (!vulkan && suite.validate)
    settings.fail("validate", "'validate' is true, but nothing runs on the backend vulkan");
  const bool traced = suite.rayTracing.empty() ||
                      std::any_of(used.begin(), used.end(), [&](const std::string& backend) {
                        return mayTraceBy(backend, suite.rayTracing);
                      });
  if (!traced) {
    settings.fail("ray_tracing", fmt::format("'ray_tracing' is '{}', which no backend in use has: "
                                             "embree is of cpu, query of vulkan, bvh of both",
                                             suite.rayTracing));
  }
}

// Registers a name by its form in file names. Fails at `place` if `seen` has the same form already:
// the images of both would have one name.
void requireUniqueName(std::map<std::string, std::string>& seen, const std::string& what,
                       const std::string& name, const std::string& place) {
  const auto [other, isNew] = seen.emplace(safeFileName(name), name);
  if (isNew) return;
  if (other->second == name) {
    failUsage(
        fmt::format("{}: two {}s are named '{}'; give each its own 'name'", place, what, name));
  }
  failUsage(
      fmt::format("{}: the {}s '{}' and '{}' are both '{}' in file names; give one another "
                  "'name'",
                  place, what, other->second, name, other->first));
}

void requireUniqueNames(const Suite& suite) {
  std::map<std::string, std::string> methods, scenes;
  for (const SuiteMethod& method : suite.methods) {
    requireUniqueName(methods, "method", method.name, method.namePlace);
    if (safeFileName(method.name) == "reference") {
      failUsage(
          fmt::format("{}: '{}' is what the images of the reference are named; give the "
                      "method another 'name'",
                      method.namePlace, method.name));
    }
  }
  for (const SuiteScene& scene : suite.scenes) {
    requireUniqueName(scenes, "scene", scene.name, scene.place);
  }
}

}  // namespace

ParameterMap SuiteMethod::parameters() const {
  if (images) return {};
  return resolveParameters(findMethod(session), session.parameters);
}

BiasClass SuiteMethod::bias(const Suite& suite) const {
  if (images) return images->bias;
  const Method method = findMethod(session);
  if (suite.lightChanges() && method.hasHistory(parameters())) return BiasClass::biased;
  return method.bias(session.mode, parameters(), suite.hasMovingCamera());
}

uint32_t Suite::maxRuns() const {
  uint32_t most = 0;
  for (const SuiteScene& scene : scenes) most = std::max(most, scene.runs.value_or(runs));
  return most;
}

uint32_t Suite::minRuns() const {
  uint32_t fewest = maxRuns();
  for (const SuiteScene& scene : scenes) fewest = std::min(fewest, scene.runs.value_or(runs));
  return fewest;
}

Suite ofScene(const Suite& suite, const SuiteScene& scene) {
  Suite own = suite;
  transportSchema().assign(own, scene.transport);
  own.warmupFrames = scene.warmupFrames.value_or(own.warmupFrames);
  own.runs = scene.runs.value_or(own.runs);
  if (scene.cameraPath) takePath(own, *scene.cameraPath, scene.cameraPathPlace);
  return own;
}

std::span<const SuiteMethod> Suite::rendered() const {
  const auto end = std::find_if(methods.begin(), methods.end(), [](const SuiteMethod& method) {
    return method.images.has_value();
  });
  return {methods.data(), size_t(end - methods.begin())};
}

uint32_t Suite::frameOfAge(uint32_t age) const {
  const uint32_t lit = events.empty() ? 0 : events.back().frame;
  return std::max(firstStillFrame(cameraPath).value_or(0), lit) + age - 1;
}

std::vector<std::string> Suite::methodBackends() const {
  std::vector<std::string> names;
  for (const SuiteMethod& method : rendered()) {
    if (std::find(names.begin(), names.end(), method.session.backend) == names.end())
      names.push_back(method.session.backend);
  }
  return names;
}

void Suite::chooseDevice(SessionConfig& config) const {
  const bool vulkan = config.backend == "vulkan";
  config.device = vulkan ? device : "";
  config.validate = vulkan && validate;
  config.rayTracing = mayTraceBy(config.backend, rayTracing) ? rayTracing : "";
}

namespace {

// Table of a suite.toml in results: bounces of the scenes' own files, kNoBounces where they have
// none. Scenes that are not in it have those of their files.
constexpr const char* kSceneBounces = "scene_bounces";

// Bounces that the scene's file suggests. Errors of the file are found when it is loaded.
int64_t suggestionOf(const SceneRequest& request) {
  const std::filesystem::path beside = std::filesystem::path(request.suiteFolder) / request.scene;
  for (const std::string& name : {request.scene, beside.string()}) {
    try {
      if (const auto bounces = suggestedBounces(name)) return int64_t(*bounces);
    } catch (const Error&) {
    }
  }
  return kNoBounces;
}

// Gives scenes the bounces of their files where the suite has none.
void takeBounces(const ConfigTable& root, const ConfigTable& settings, Suite& suite) {
  const ConfigTable kept = root.getTable(kSceneBounces);
  for (SuiteScene& scene : suite.scenes) {
    const int64_t ofTable = kept.getInteger(scene.name, kNoBounces, kNoBounces, 1024);
    if (settings.has("max_bounces") || scene.transport.contains("max_bounces")) continue;
    if (isBuiltinScene(scene.request.scene)) continue;
    const int64_t bounces = kept.has(scene.name) ? ofTable : suggestionOf(scene.request);
    scene.suggestedBounces = bounces;
    if (bounces != kNoBounces) scene.transport["max_bounces"] = bounces;
  }
  kept.finish();
}

// Reads one point of the sweep over settings. `root`: with all overrides and this point's values.
Suite readSuite(const ConfigTable& root, const std::filesystem::path& file, const Sweep& sweep) {
  Suite suite;
  suite.file = file.string();
  suite.name = root.getString("name", file.stem().string());
  suite.question = root.getString("question", "");
  for (const char* key :
       {"scenes", "scene", "method", "settings", "reference", "sweep", "camera_path", "event",
        "mask", kSceneBounces, "view"})  // view: what the viewer shows beside methods
    root.has(key);
  root.finish();
  const std::string folder = file.parent_path().string();
  for (const std::string& name : root.getStrings("scenes")) {
    SuiteScene scene;
    scene.request.scene = name;
    scene.request.suiteFolder = folder;
    scene.name = shownName(name);
    scene.place = root.place("scenes");
    scene.cameraPlace = scene.environmentPlace = scene.referencePlace = scene.place;
    suite.scenes.push_back(scene);
  }
  size_t sweeps = 0;
  for (const ConfigTable& table : root.getTables("scene")) {
    for (SuiteScene& scene : readScenes(table, folder, ++sweeps))
      suite.scenes.push_back(std::move(scene));
  }
  if (suite.scenes.empty())
    root.fail("", "the suite has no scenes: give scenes = [..] or [[scene]]");
  const ConfigTable settings = root.getTable("settings");
  std::set<std::string> swept;
  for (const SweepAxis& axis : sweep.settings) swept.insert(axis.leaf);
  readSettings(settings, suite, swept);
  takeBounces(root, settings, suite);
  readPaths(root, suite);
  takePath(suite, suite.cameraPathName, suite.cameraPathPlace);
  for (const SuiteScene& scene : suite.scenes) checkPath(settings, ofScene(suite, scene));
  readMasks(root, suite);
  readMethods(root, settings, sweep, folder, suite);
  readReference(root.getTable("reference"), suite);
  requireSomeUse(settings, suite);
  nameByBackend(suite);
  requireUniqueNames(suite);
  followBaseline(settings, suite);
  return suite;
}

// Rejects swept seeds that are closer than the number of runs: run r has the seed `seed` + r, so
// two points would share runs that look independent.
void requireOwnSeeds(const std::vector<SweepAxis>& axes, const std::vector<Suite>& points) {
  const Suite& last = points.back();
  for (const SweepAxis& axis : axes) {
    if (axis.leaf != "seed") continue;
    for (const Suite& other : points) {
      const uint32_t apart =
          other.seed < last.seed ? last.seed - other.seed : other.seed - last.seed;
      if (apart == 0 || apart >= std::min(last.maxRuns(), other.maxRuns())) continue;
      failUsage(
          fmt::format("{}: seeds {} and {} have runs in common, as run r has the seed "
                      "'seed' + r; leave at least {} between them",
                      axis.place, other.seed, last.seed, last.maxRuns()));
    }
  }
}

// Rejects --set of a swept key, whose value the sweep would replace.
void requireSetKeysAreNotSwept(const Sweep& sweep, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) {
    const std::string key = splitAssignment(assignment).first;
    std::string method, leaf = key.rfind("settings.", 0) == 0 ? key.substr(9) : key;
    const bool isOfMethods = splitMethodKey(key, method, leaf);
    // A swept `backend` belongs to the methods, not to the list of [settings].
    const bool isBackend = !isOfMethods && leaf == "backend";
    for (const SweepAxis& axis : isOfMethods || isBackend ? sweep.methods : sweep.settings) {
      const bool isAll = axis.method.empty() || axis.method == method;
      if (axis.leaf != leaf || !isAll) continue;
      failUsage(
          fmt::format("{}: the values of this sweep replace that of --set {}; --sweep "
                      "{}=VALUE gives it a single one",
                      axis.place, key, axis.key));
    }
  }
}

// findSuite(), or an error that names the installed suites for a name that is none.
std::filesystem::path foundSuite(const std::filesystem::path& name) {
  const std::filesystem::path file = findSuite(name);
  const std::vector<std::string> known = installedSuites();
  std::error_code status;
  if (!known.empty() && !name.has_parent_path() && !std::filesystem::exists(file, status)) {
    failUsage(fmt::format("{}: no such file, and no installed suite (there are {}){}",
                          name.string(), fmt::join(known, ", "),
                          didYouMean(name.stem().string(), known)));
  }
  return file;
}

}  // namespace

std::vector<Suite> loadSuites(const std::filesystem::path& name,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::string>& sweeps) {
  const std::filesystem::path file = foundSuite(name);
  const auto load = [&] {
    ConfigTable root = ConfigTable::parseFile(file);
    for (const std::string& assignment : overrides) applyOverride(root, assignment);
    for (const std::string& assignment : sweeps) {
      const auto [key, values] = splitAssignment(assignment, "--sweep");
      root.getTable("sweep").assign(key, sweepValues(key, values), "--sweep " + key);
    }
    return root;
  };
  ConfigTable root = load();
  const Sweep sweep = readSweep(root, settingsKeys());
  requireSetKeysAreNotSwept(sweep, overrides);
  std::vector<Suite> points;
  for (const std::vector<size_t>& choice : combinations(sweep.settings)) {
    const ConfigTable point = load();
    ConfigTable settings = point.getTable("settings");
    for (size_t i = 0; i < choice.size(); ++i) {
      const SweepAxis& axis = sweep.settings[i];
      settings.assign(axis.leaf, axis.texts[choice[i]], axis.place);
    }
    points.push_back(readSuite(point, file, sweep));
    requireOwnSeeds(sweep.settings, points);
    points.back().swept = sweptValues(sweep.settings, choice);
    points.back().point = sweepLabel(points.back().swept);
    for (const SuiteScene& scene : points.back().scenes)
      if (scene.suggestedBounces)
        root.getTable(kSceneBounces)
            .assign(scene.name, std::to_string(*scene.suggestedBounces), "a scene's file");
    points.back().resolved = root.text();
  }
  return points;
}

Suite loadSuite(const std::filesystem::path& name, const std::vector<std::string>& overrides) {
  std::vector<Suite> points = loadSuites(name, overrides, {});
  if (points.size() > 1) {
    failUsage(fmt::format("{}: [sweep] makes {} tables, where one is meant", name.string(),
                          points.size()));
  }
  return std::move(points.front());
}

}  // namespace restlab
