#include "experiments/runner/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/backend/backend.h"
#include "core/caches/caches.h"
#include "core/config.h"
#include "core/error.h"
#include "core/image/metrics.h"
#include "denoise/denoiser.h"
#include "experiments/runner/backend_choice.h"
#include "experiments/runner/files.h"
#include "experiments/runner/suite_overrides.h"
#include "experiments/runner/sweep.h"

namespace restlab {

namespace {

constexpr int64_t kMaxCount = 1000000;

SuiteScene readScene(const ConfigTable& table, const std::string& folder) {
  SuiteScene scene;
  scene.request.suiteFolder = folder;
  scene.request.scene = table.getString("scene", "");
  scene.request.camera = table.getString("camera", "");
  scene.request.environment = table.getString("environment", "");
  if (table.has("environment_rotation")) {
    scene.request.environmentRotation = table.getNumber("environment_rotation", 0.0, -360.0, 360.0);
  }
  if (table.has("environment_scale")) {
    scene.request.environmentScale = table.getNumber("environment_scale", 1.0, 0.0, 1e9);
  }
  const std::filesystem::path path(scene.request.scene);
  scene.name = table.getString("name", path.stem().string());
  scene.reference = table.getString("reference", "");
  scene.place = table.place("scene");
  scene.cameraPlace = table.place("camera");
  scene.referencePlace = table.place("reference");
  scene.width = uint32_t(table.getInteger("width", 0, 1, kMaxSide));
  scene.height = uint32_t(table.getInteger("height", 0, 1, kMaxSide));
  scene.optional = table.getBool("optional", false);
  table.finish();
  if (scene.request.scene.empty()) table.fail("scene", "[[scene]] needs a key 'scene'");
  return scene;
}

// One name or several; "cpu" and so on, each once.
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

// A row of images: [[method]] with a key 'image'.
SuiteMethod readImageRow(const ConfigTable& table, const std::string& folder) {
  ImageRow row;
  row.files = table.getStrings("image");
  row.filesPlace = table.place("image");
  row.folder = folder;
  if (row.files.empty()) table.fail("image", "'image' is empty");
  if (table.has("time_ms")) {
    const size_t count = table.getTexts("time_ms").size();
    if (count != 1 && count != row.files.size()) {
      table.fail("time_ms", fmt::format("'time_ms' has {} numbers for {} image{}; one for each, or "
                                        "one number for all",
                                        count, row.files.size(), row.files.size() == 1 ? "" : "s"));
    }
    row.timesMs = table.getNumbers("time_ms", {}, count == 1 ? 1 : row.files.size(), 1e-9, 1e12);
    if (count == 1) row.timesMs.resize(row.files.size(), row.timesMs.front());
  }
  const std::string bias = table.getChoice("bias", "biased", {"unbiased", "consistent", "biased"});
  row.bias = bias == "unbiased"     ? BiasClass::unbiased
             : bias == "consistent" ? BiasClass::consistent
                                    : BiasClass::biased;
  SuiteMethod method;
  method.name = method.base = method.given = table.getString("name", "");
  method.namePlace = table.place("name");
  if (method.name.empty()) table.fail("name", "[[method]] with 'image' needs a 'name'");
  for (const char* key : {"integrator", "mode", "cache", "backend", "denoiser"}) {
    if (table.has(key))
      table.fail(
          key,
          fmt::format("'{}' and 'image' exclude each other: images are not rendered here", key));
  }
  table.finish();
  method.session.integrator = "image";
  method.session.mode = method.session.cache = method.session.backend = "none";
  method.images = std::move(row);
  return method;
}

// A method, once for each of its backends.
std::vector<SuiteMethod> readMethod(const ConfigTable& table, const ConfigTable& settings,
                                    const Suite& suite) {
  SuiteMethod method;
  std::vector<std::string> integrators;
  for (const IntegratorInfo* info : integratorRegistry()) integrators.push_back(info->name);
  method.session.integrator = table.getChoice("integrator", "path", integrators);
  const IntegratorInfo& info = findIntegrator(method.session.integrator);
  std::vector<std::string> modes;
  for (const ModeInfo& mode : info.modes) modes.push_back(mode.name);
  method.session.mode = table.getChoice("mode", modes.front(), modes);
  std::vector<std::string> caches;
  for (const CacheInfo& cache : cacheRegistry()) caches.push_back(cache.name);
  method.session.cache = table.getChoice("cache", "pixel", caches);
  method.session.specialise = !table.getBool("general", false);
  std::vector<std::string> denoisers;
  for (const DenoiserInfo* denoiser : denoiserRegistry()) denoisers.push_back(denoiser->name);
  method.session.denoiser = table.getChoice("denoiser", "none", denoisers);
  const std::string fallback =
      info.name + (modes.size() < 2 ? "" : " (" + method.session.mode + ")");
  method.name = table.getString("name", fallback);
  for (const ParameterInfo& parameter : info.parameters) {
    if (const auto value = table.getParameter(parameter)) {
      method.session.parameters[parameter.name] = *value;
    }
  }
  const std::vector<std::string> backends = readBackends(table, suite.backends);
  table.finish();
  method.base = method.given = method.name;
  method.namePlace = table.place("name");
  const bool isGeneral = !table.has("backend") && settings.has("backend");
  method.backendPlace = (isGeneral ? settings : table).place("backend");
  std::vector<SuiteMethod> all;
  for (const std::string& backend : backends) {
    method.session.backend = backend;
    suite.chooseDevice(method.session);
    all.push_back(method);
  }
  return all;
}

// Whether a sweep over all methods means this integrator: `path` has one mode and no cache.
bool isMeant(const SweepAxis& axis, const std::string& integrator) {
  const std::vector<std::string> known = methodKeys(integrator);
  if (std::find(known.begin(), known.end(), axis.leaf) == known.end()) return false;
  if (!axis.method.empty()) return true;
  for (const IntegratorInfo* info : integratorRegistry()) {
    if (info->name != integrator) continue;
    if (axis.leaf == "mode") return info->modes.size() > 1;
    if (axis.leaf == "cache") return info->usesCache;
  }
  return true;
}

// A method's table once for every combination of what is swept of it.
std::vector<SuiteMethod> readMethods(ConfigTable& table, const ConfigTable& settings,
                                     const Sweep& sweep, const Suite& suite) {
  const std::string integrator = table.getString("integrator", "path");
  const std::string name = table.getString("name", integrator);
  const bool isNamed = table.has("name");
  std::vector<std::string> integrators = {integrator};
  for (const SweepAxis& axis : sweep.methods) {
    if (axis.leaf != "integrator") continue;
    for (const std::string& text : axis.texts) integrators.push_back(unquoted(text));
  }
  std::vector<SweepAxis> axes;
  for (const SweepAxis& axis : sweep.methods) {
    if (!axis.method.empty() && axis.method != name) continue;
    const bool isKnown = std::any_of(integrators.begin(), integrators.end(),
                                     [&](const std::string& of) { return isMeant(axis, of); });
    if (isKnown) axes.push_back(axis);
  }
  std::vector<SuiteMethod> all;
  for (const std::vector<size_t>& choice : combinations(axes)) {
    std::vector<SweepAxis> shown;
    std::vector<size_t> shownChoice;
    for (size_t i = 0; i < axes.size(); ++i) {
      table.assign(axes[i].leaf, axes[i].texts[choice[i]], axes[i].place);
      // A method without a name of its own is named by its integrator and mode.
      if (!isNamed && (axes[i].leaf == "integrator" || axes[i].leaf == "mode")) continue;
      if (axes[i].leaf == "backend") continue;  // nameByBackend() says it
      shown.push_back(axes[i]);
      shownChoice.push_back(choice[i]);
    }
    for (SuiteMethod& method : readMethod(table, settings, suite)) {
      const std::string label = sweepLabel(shown, shownChoice);
      if (!label.empty()) method.name = method.base = fmt::format("{}, {}", method.base, label);
      all.push_back(std::move(method));
    }
  }
  return all;
}

// In a table of several backends every name says which one it is of.
void nameByBackend(Suite& suite) {
  if (suite.methodBackends().size() < 2) return;
  for (SuiteMethod& method : suite.methods) {
    if (!method.images) method.name = fmt::format("{} @{}", method.base, method.session.backend);
  }
}

// A setting that no backend in use could have would be ignored in silence.
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

void readMasks(const ConfigTable& root, Suite& suite) {
  for (const ConfigTable& table : root.getTables("mask")) {
    SuiteMask mask;
    mask.place = table.place("");
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

void readSettings(const ConfigTable& table, Suite& suite) {
  suite.width = uint32_t(table.getInteger("width", 0, 1, kMaxSide));
  suite.height = uint32_t(table.getInteger("height", 0, 1, kMaxSide));
  suite.maxBounces = uint32_t(table.getInteger("max_bounces", suite.maxBounces, 0, 1024));
  suite.multiscatter = table.getBool("multiscatter", suite.multiscatter);
  suite.russianRoulette = table.getBool("russian_roulette", suite.russianRoulette);
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
  suite.baseline = table.getString("baseline", suite.baseline);
  for (const std::string& given : table.getStrings("metrics", {}))
    addMetric(table, given, suite.metrics);
  suite.pixelFilter = parseFilter(table.getString("filter", "box"), table.place("filter"));
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
  for (const int64_t frame : table.getIntegers("checkpoints", {}, 0, kMaxCount)) {
    if (frame >= suite.warmupFrames + suite.timedFrames) {
      table.fail("checkpoints", fmt::format("'checkpoints' has {}, but a run ends at frame {}",
                                            frame, suite.warmupFrames + suite.timedFrames - 1));
    }
    suite.checkpoints.push_back(uint32_t(frame));
  }
  table.finish();
}

// The [[camera_path]] that the settings name; "still" needs none.
void chooseCameraPath(const ConfigTable& root, const ConfigTable& settings, Suite& suite) {
  std::vector<std::string> names = {"still"};
  bool isFound = suite.cameraPathName == "still";
  for (const ConfigTable& table : root.getTables("camera_path")) {
    const std::string name = table.getString("name", "");
    if (name.empty()) table.fail("name", "[[camera_path]] needs a 'name'");
    if (std::find(names.begin(), names.end(), name) != names.end())
      table.fail("name", fmt::format("two camera paths are named '{}'", name));
    names.push_back(name);
    const CameraPath path = parseCameraPath(table);
    if (name != suite.cameraPathName) continue;
    suite.cameraPath = path;
    isFound = true;
  }
  if (!isFound) {
    settings.fail("camera_path",
                  fmt::format("no [[camera_path]] is named '{}'{}", suite.cameraPathName,
                              didYouMean(suite.cameraPathName, names)));
  }
  if (!suite.hasMovingCamera()) return;
  // There is one reference, of the measured frame's camera.
  if (!suite.checkpoints.empty())
    settings.fail("checkpoints",
                  "'checkpoints' are of a still camera: each would need a reference");
  if (suite.accumulate)
    settings.fail("accumulate", "'accumulate' is of a still camera: frames of a moving one differ");
}

// The keys that [settings] has: those that readSettings() asks for.
const std::vector<std::string>& settingsKeys() {
  static const std::vector<std::string> keys = [] {
    const ConfigTable table = ConfigTable::parseText("", "settings");
    Suite suite;
    readSettings(table, suite);
    return table.known();
  }();
  return keys;
}

void readReference(const ConfigTable& table, Suite& suite) {
  suite.referenceBackend = table.getChoice("backend", suite.referenceBackend, backendNames());
  suite.referenceBackendPlace = table.place("backend");
  ReferenceTarget& target = suite.target;
  target.spp = uint64_t(table.getInteger("spp", 0, 2, int64_t(1) << 32));
  target.relmse = table.getNumber("target_relmse", 0.0, 1e-12, 1e6);
  target.timeLimitS = table.getNumber("time_limit", 0.0, 1e-3, 1e9);
  if (target.spp == 0 && target.relmse == 0.0 && target.timeLimitS == 0.0) target.spp = 256;
  table.finish();
}

// Notes a name by what file names keep of it. Fails at `place` where another one, in `seen`, is or
// looks the same: the images of both would have one name.
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

void requireBaseline(const ConfigTable& settings, const Suite& suite) {
  std::vector<std::string> names;
  for (const SuiteMethod& method : suite.rendered()) names.push_back(method.name);
  if (suite.baseline.empty() ||
      std::find(names.begin(), names.end(), suite.baseline) != names.end())
    return;
  settings.fail(
      "baseline",
      fmt::format("no method that is rendered is named '{}' (there are: '{}'){}", suite.baseline,
                  fmt::join(names, "', '"), didYouMean(suite.baseline, names)));
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

std::string SuiteMethod::cacheName() const {
  return !images && hasHistory(session) ? session.cache : "none";
}

ParameterMap SuiteMethod::parameters() const {
  if (images) return {};
  return resolveParameters(findIntegrator(session.integrator), session.parameters);
}

BiasClass SuiteMethod::bias() const {
  if (images) return images->bias;
  return biasClassOf(findIntegrator(session.integrator), session.mode, parameters());
}

std::span<const SuiteMethod> Suite::rendered() const {
  const auto end = std::find_if(methods.begin(), methods.end(), [](const SuiteMethod& method) {
    return method.images.has_value();
  });
  return {methods.data(), size_t(end - methods.begin())};
}

size_t Suite::yardstick(size_t method) const {
  const std::span<const SuiteMethod> all = rendered();
  if (!baseline.empty()) {
    const auto named = std::find_if(
        all.begin(), all.end(), [&](const SuiteMethod& other) { return other.name == baseline; });
    return named == all.end() ? methods.size() : size_t(named - all.begin());
  }
  for (size_t other = 0; other < all.size(); ++other) {
    const SessionConfig& session = all[other].session;
    const std::string& backend =
        (methods[method].images ? all.front() : methods[method]).session.backend;
    if (session.integrator == "path" && session.backend == backend) return other;
  }
  return methods.size();
}

size_t Suite::onFirstBackend(size_t method) const {
  const SuiteMethod& own = methods[method];
  if (own.images) return method;
  const auto first = std::find_if(methods.begin(), methods.end(), [&](const SuiteMethod& other) {
    const SessionConfig &a = own.session, &b = other.session;
    return own.base == other.base && a.integrator == b.integrator && a.mode == b.mode &&
           a.cache == b.cache && a.specialise == b.specialise && a.parameters == b.parameters;
  });
  return size_t(first - methods.begin());
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

// One point of the sweep over settings. `root` holds all overrides and this point's values.
Suite readSuite(const ConfigTable& root, const std::filesystem::path& file, const Sweep& sweep) {
  Suite suite;
  suite.file = file.string();
  suite.name = root.getString("name", file.stem().string());
  suite.question = root.getString("question", "");
  for (const char* key :
       {"scenes", "scene", "method", "settings", "reference", "sweep", "camera_path", "mask"})
    root.has(key);
  root.finish();
  const std::string folder = file.parent_path().string();
  for (const std::string& name : root.getStrings("scenes")) {
    SuiteScene scene;
    scene.request.scene = name;
    scene.request.suiteFolder = folder;
    scene.name = std::filesystem::path(name).stem().string();
    scene.place = scene.cameraPlace = scene.referencePlace = root.place("scenes");
    suite.scenes.push_back(scene);
  }
  for (const ConfigTable& table : root.getTables("scene")) {
    suite.scenes.push_back(readScene(table, folder));
  }
  if (suite.scenes.empty())
    root.fail("", "the suite has no scenes: give scenes = [..] or [[scene]]");
  const ConfigTable settings = root.getTable("settings");
  readSettings(settings, suite);
  chooseCameraPath(root, settings, suite);
  readMasks(root, suite);
  std::vector<SuiteMethod> imageRows;
  for (ConfigTable& table : root.getTables("method")) {
    if (table.has("image")) {
      imageRows.push_back(readImageRow(table, folder));
      continue;
    }
    for (SuiteMethod& method : readMethods(table, settings, sweep, suite))
      suite.methods.push_back(std::move(method));
  }
  if (suite.methods.empty()) root.fail("", "the suite has no [[method]] that is rendered");
  std::move(imageRows.begin(), imageRows.end(), std::back_inserter(suite.methods));
  readReference(root.getTable("reference"), suite);
  requireSomeUse(settings, suite);
  nameByBackend(suite);
  requireUniqueNames(suite);
  requireBaseline(settings, suite);
  return suite;
}

}  // namespace

std::vector<Suite> loadSuites(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::string>& sweeps) {
  const auto load = [&] {
    ConfigTable root = ConfigTable::parseFile(file);
    for (const std::string& assignment : overrides) applyOverride(root, assignment);
    for (const std::string& assignment : sweeps) {
      const auto [key, values] = splitAssignment(assignment, "--sweep");
      root.getTable("sweep").assign(key, sweepValues(key, values), "--sweep " + key);
    }
    return root;
  };
  const ConfigTable root = load();
  const Sweep sweep = readSweep(root, settingsKeys());
  std::vector<Suite> points;
  for (const std::vector<size_t>& choice : combinations(sweep.settings)) {
    const ConfigTable point = load();
    ConfigTable settings = point.getTable("settings");
    for (size_t i = 0; i < choice.size(); ++i) {
      const SweepAxis& axis = sweep.settings[i];
      settings.assign(axis.leaf, axis.texts[choice[i]], axis.place);
    }
    points.push_back(readSuite(point, file, sweep));
    points.back().point = sweepLabel(sweep.settings, choice);
    points.back().resolved = root.text();
  }
  return points;
}

Suite loadSuite(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  std::vector<Suite> points = loadSuites(file, overrides, {});
  if (points.size() > 1) {
    failUsage(fmt::format("{}: [sweep] makes {} tables, where one is meant", file.string(),
                          points.size()));
  }
  return std::move(points.front());
}

}  // namespace restlab
