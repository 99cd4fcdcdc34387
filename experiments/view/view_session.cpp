#include "experiments/view/view_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/frame/integrator.h"
#include "core/image/metrics/window.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/reference/beside_reference.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/run/render_command.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/suite/picture.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (uint8_t(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", uint8_t(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

// Formats a TOML float that reads back exactly; never a whole number.
std::string numberText(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string valueText(const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return numberText(*number);
  return quoted(std::get<std::string>(value));
}

std::string pointText(const glm::dvec3& p) {
  return fmt::format("[{}, {}, {}]", numberText(p.x), numberText(p.y), numberText(p.z));
}

glm::dvec3 forwardOf(const SceneCamera& camera) {
  return glm::normalize(-glm::dvec3(camera.cameraToWorld[2]));
}

std::optional<size_t> sceneCameraOf(const LiveView& view) {
  const std::vector<SceneCamera>& cameras = view.loaded().scene->source().cameras;
  for (size_t i = 0; i < cameras.size(); ++i)
    if (isSameCamera(cameras[i], view.camera())) return i;
  return std::nullopt;
}

bool isOwnCamera(const LiveView& view) {
  const PreparedScene& loaded = view.loaded();
  return isSameCamera(loaded.scene->source().cameras.at(loaded.camera), view.camera());
}

std::string sceneToml(const ViewFacts& facts, const MaterialEdits& edits,
                      const std::string& sceneTitle) {
  const SceneRequest request = fromAnywhere(facts.request);
  const bool hasSettings = !splitSceneSettings(request.scene).second.empty();
  const std::string scene =
      request.scene + (edits.empty() ? "" : (hasSettings ? "&" : "?") + settingsText(edits));
  std::string text = fmt::format("[[scene]]\nscene = {}\n", quoted(scene));
  // Without it the settings would be part of the names of files.
  if (!edits.empty()) text += fmt::format("name = {}\n", quoted(sceneTitle));
  if (!request.camera.empty()) text += fmt::format("camera = {}\n", quoted(request.camera));
  if (!request.environment.empty())
    text += fmt::format("environment = {}\n", quoted(request.environment));
  if (request.environmentRotation)
    text += fmt::format("environment_rotation = {}\n", numberText(*request.environmentRotation));
  if (request.environmentScale)
    text += fmt::format("environment_scale = {}\n", numberText(*request.environmentScale));
  return text;
}

std::string nameOf(const SessionConfig& config) {
  const bool hasModes = findIntegrator(config.integrator).modes.size() > 1;
  return config.integrator + (hasModes ? " (" + config.mode + ")" : "") +
         (config.denoiser == "none" ? "" : " + " + config.denoiser);
}

// Ratios are against the last pane; tables of several backends name it with its backend.
std::string baselineOf(const ViewSettings& settings) {
  const SessionConfig &first = settings.panes.front().config, &last = settings.panes.back().config;
  const std::string name = methodNames(settings).back();
  return first.backend == last.backend ? name : fmt::format("{} @{}", name, last.backend);
}

std::string settingsToml(const LiveView& view) {
  const ViewSettings& settings = view.settings();
  const SessionConfig& first = settings.panes.front().config;
  std::string text = fmt::format(
      "\n[settings]\nwidth = {}\nheight = {}\nseed = {}\ncomponents = [{}]\nbaseline = {}\n",
      first.width, first.height, view.firstSeed() & 0x7fffffffu,
      quoted(componentName(first.components)), quoted(baselineOf(settings)));
  for (const ParameterInfo& info : transportSchema().infos(first))
    text += fmt::format("{} = {}\n", info.name, valueText(info.defaultValue));
  if (first.threads > 0) text += fmt::format("threads = {}\n", first.threads);
  for (const PaneSettings& pane : settings.panes) {
    const SessionConfig& config = pane.config;
    if (!config.device.empty()) text += fmt::format("device = {}\n", quoted(config.device));
    if (config.validate) text += "validate = true\n";
    if (!config.device.empty() || config.validate) break;
  }
  for (const PaneSettings& pane : settings.panes) {
    if (pane.config.rayTracing.empty()) continue;
    text += fmt::format("ray_tracing = {}\n", quoted(pane.config.rayTracing));
    break;
  }
  if (!isOwnCamera(view)) text += "camera_path = \"view\"\n";
  return text;
}

std::string cameraToml(const LiveView& view) {
  if (isOwnCamera(view)) return "";
  std::string text =
      "\n[[camera_path]]\nname = \"view\"\nkind = \"keyframes\"\n\n[[camera_path.keyframe]]\n"
      "frame = 0\n";
  if (const std::optional<size_t> index = sceneCameraOf(view))
    return text + fmt::format("camera = {}\n", quoted(std::to_string(*index)));
  const SceneCamera& camera = view.camera();
  const glm::dvec3 position(camera.cameraToWorld[3]), forward = forwardOf(camera);
  if (glm::length(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0))) < 1e-4) {
    failUsage(
        "save: the camera looks straight up or down, which no keyframe of a suite does; tilt it a "
        "little");
  }
  text += fmt::format("position = {}\ntarget = {}\n", pointText(position),
                      pointText(position + forward));
  if (camera.kind == rl::RL_CAMERA_PERSPECTIVE) {
    text += fmt::format("yfov_degrees = {}\n",
                        numberText(camera.yfov * 180.0 / 3.14159265358979323846));
  }
  return text;
}

std::string methodToml(const PaneSettings& pane, const std::string& name) {
  const SessionConfig& config = pane.config;
  std::string text = fmt::format("\n[[method]]\nname = {}\nintegrator = {}\n", quoted(name),
                                 quoted(config.integrator));
  for (const auto& [key, value] : {std::pair("mode", config.mode), {"cache", config.cache}}) {
    if (!value.empty()) text += fmt::format("{} = {}\n", key, quoted(value));
  }
  text +=
      fmt::format("denoiser = {}\nbackend = {}\n", quoted(config.denoiser), quoted(config.backend));
  if (config.kernels != defaultKernelChoice())
    text += fmt::format("kernels = {}\n", quoted(kernelChoiceName(config.kernels)));
  for (const auto& [key, value] : config.parameters)
    text += fmt::format("{} = {}\n", key, valueText(value));
  return text;
}

// True if the camera's right is not horizontal.
bool isRolled(const SceneCamera& camera) {
  return std::abs(glm::normalize(glm::dvec3(camera.cameraToWorld[0])).y) > 1e-6;
}

ViewSettings settingsOfSuite(const Suite& suite, const SuiteScene& scene,
                             const PreparedScene& prepared) {
  uint32_t width = 0, height = 0;
  sceneResolution(suite, scene, prepared, width, height);
  const SessionConfig picture = pictureOf(suite, width, height, suite.components.front());
  std::vector<SessionConfig> panes;
  for (const SuiteMethod& method : suite.rendered()) {
    if (panes.size() < kMostPanes) panes.push_back(methodConfig(suite, method, prepared, picture));
  }
  if (panes.empty()) failUsage(suite.file + ": has no method that is rendered");
  if (panes.size() < kMostPanes) {
    SuiteMethod average;
    average.session.denoiser = "accumulate";
    average.session.backend = panes.front().backend;
    panes.push_back(methodConfig(suite, average, prepared, picture));
  }
  ViewSettings settings = settingsOf(prepared, panes);
  settings.firstSeed = suite.seed;
  if (const auto motion = motionOf(suite, scene, prepared))
    settings.camera = cameraAt(*motion, suite.warmupFrames);
  LightFactors events;
  for (const LightEvent& event : suite.events) {
    if (event.frame > suite.warmupFrames) continue;
    atPlace(event.place, [&] { requireLight(prepared.scene->source(), event.light); });
    events.emplace_back(event.light, event.factor);
  }
  settings.lights = ownLights(events, prepared.scene->source());
  return settings;
}

constexpr const char* kSourceKeys[kMostPanes] = {"a", "b"};
constexpr const char* kSeedKeys[kMostPanes] = {"seed_a", "seed_b"};
constexpr const char* kMethodWord = "method";

// Reads "method", "reference" or the file of an image.
std::string sourceOf(const ConfigTable& table, const char* key, const ViewImages& images) {
  const std::string given = table.getString(key, kMethodWord);
  if (given == kMethodWord) return kMethodSource;
  if (given == kReferenceSource) return kReferenceSource;
  for (const FileImage& one : images.list)
    if (one.file.string() == given) return one.name;
  table.fail(key, fmt::format("'{}' must be \"method\", \"reference\" or one of 'images'", given));
}

void readView(const ConfigTable& table, bool anyReference, ViewStart& start) {
  if (table.has("results")) {
    const std::string results = table.getString("results", ""), of = table.getString("table", "");
    if (start.prepared.scene) table.fail("results", "is for a session without a scene");
    if (table.has("images")) table.fail("images", "'results' has the images");
    start.images = readResultsImages(results, of, anyReference);
    start.settings = settingsOf(start.images);
    return table.finish();
  }
  const std::vector<std::string> files = table.getStrings("images");
  const std::string reference = table.getString("reference", "");
  const bool hasScene = start.prepared.scene != nullptr;
  if (hasScene && !reference.empty())
    table.fail("reference", "is for images without a scene; methods make their own reference");
  if (!files.empty()) {
    start.images = readViewImages({files.begin(), files.end()}, reference, !hasScene, anyReference);
    requireSizeOf(start.images, start.settings, hasScene);
    if (!anyReference) requireImagesOf(start);
  } else if (!hasScene) {
    table.fail("images", "a session without a scene needs 'images'");
  }
  if (!hasScene) start.settings = settingsOf(start.images);
  for (size_t i = 0; i < kMostPanes; ++i) {
    if (hasScene && table.has(kSeedKeys[i])) {
      const uint32_t most = ~uint32_t{0};
      start.settings.panes[i].config.seed = uint32_t(table.getInteger(kSeedKeys[i], 0, 0, most));
    }
    if (!table.has(kSourceKeys[i])) continue;
    const std::string source = sourceOf(table, kSourceKeys[i], start.images);
    if (!hasScene && source == kMethodSource)
      table.fail(kSourceKeys[i], "without a scene there is no method to show");
    if (!hasScene && source == kReferenceSource && !start.images.reference)
      table.fail(kSourceKeys[i], "there is no 'reference'");
    // Older files without a scene chose two images; all of them are shown.
    if (hasScene) start.settings.panes[i].source = source;
  }
  table.finish();
}

std::string viewToml(const LiveView& view) {
  const ViewImages& images = view.images();
  const auto isMethod = [](const PaneSettings& pane) { return pane.source == kMethodSource; };
  const std::vector<PaneSettings>& panes = view.settings().panes;
  std::string seeds;
  for (size_t i = 0; i < panes.size() && view.hasScene(); ++i) {
    const uint32_t seed = panes[i].config.seed;
    if (seed != view.firstSeed()) seeds += fmt::format("{} = {}\n", kSeedKeys[i], seed);
  }
  if (images.list.empty() && std::all_of(panes.begin(), panes.end(), isMethod))
    return seeds.empty() ? "" : "\n[view]\n" + seeds;
  std::string text = "\n[view]\n" + seeds;
  const auto absolute = [](const fs::path& file) { return quoted(fs::absolute(file).string()); };
  if (!images.folder.empty()) {
    return text +
           fmt::format("results = {}\ntable = {}\n", absolute(images.folder), quoted(images.table));
  }
  std::vector<std::string> files;
  for (const FileImage& one : images.list) files.push_back(absolute(one.file));
  if (!files.empty()) text += fmt::format("images = [{}]\n", fmt::join(files, ", "));
  if (images.reference) text += fmt::format("reference = {}\n", absolute(images.referenceFile));
  for (size_t i = 0; view.hasScene() && i < panes.size(); ++i) {
    const FileImage* image = images.find(panes[i].source);
    text += fmt::format("{} = {}\n", kSourceKeys[i],
                        image                ? absolute(image->file)
                        : isMethod(panes[i]) ? quoted(kMethodWord)
                                             : quoted(kReferenceSource));
  }
  return text;
}

}  // namespace

void requireSizeOf(const ViewImages& images, const ViewSettings& settings, bool hasScene) {
  if (!hasScene || images.list.empty()) return;
  const FileImage& first = images.list.front();
  const SessionConfig& size = settings.panes.front().config;
  const PixelWindow window = windowOf(first.image), rendered{{0, 0}, size.width, size.height};
  if (window == rendered) return;
  failInput(fmt::format("{}: is {}, and the methods render {}; images of one {} can be compared",
                        first.file.string(), windowText(window, rendered),
                        windowText(rendered, window),
                        window.origin == rendered.origin ? "size" : "window"));
}

void requireImagesOf(const ViewStart& start) {
  if (!start.prepared.scene) return;
  std::map<std::string, std::string> words =
      describe(start.prepared, start.settings.panes.front().config);
  describeCamera(start.settings.camera, words);
  // Ignore the program's version, since images of other versions may be compared, and the camera's
  // index, since its numbers identify it.
  for (const char* item : {"camera_index", "reference_sources"}) words.erase(item);
  if (!start.settings.lights.empty()) return;  // no file says which lights were changed by hand
  for (const FileImage& one : start.images.list) {
    requireOfReference(one.file.string(), one.metadata,
                       "scene " + start.prepared.scene->source().name, words);
  }
}

ViewStart startOfSuite(const fs::path& file, bool anyReference) {
  const ConfigTable root = ConfigTable::parseFile(file);
  ViewStart start;
  if (!root.has("view") || root.has("scene") || root.has("scenes")) {
    const Suite whole = loadSuites(file, {}, {}).front();
    const SuiteScene& scene = whole.scenes.front();
    const Suite suite = ofScene(whole, scene);
    start.request = scene.request;
    start.prepared = atPlace(scene.place, [&] { return prepareScene(scene.request); });
    start.settings = settingsOfSuite(suite, scene, start.prepared);
  }
  if (root.has("view")) readView(root.getTable("view"), anyReference, start);
  return start;
}

std::vector<std::string> paneNames(const LiveView& view) {
  std::vector<std::string> names;
  if (view.hasScene()) names = methodNames(view.settings());
  names.resize(view.panes());
  for (size_t i = 0; i < view.panes(); ++i)
    if (!view.renders(i)) names[i] = view.settings().panes[i].source;
  return names;
}

std::vector<std::string> methodNames(const ViewSettings& settings) {
  std::vector<std::string> names;
  for (const PaneSettings& pane : settings.panes) {
    const std::string name = nameOf(pane.config);
    const bool isTaken = std::find(names.begin(), names.end(), name) != names.end();
    names.push_back(isTaken ? name + " B" : name);
  }
  return names;
}

bool losesRoll(const LiveView& view) {
  return view.hasScene() && !sceneCameraOf(view) && isRolled(view.camera());
}

std::string sessionName(const LiveView& view) {
  std::string time = utcNow();  // 2024-05-01T12:00:00Z
  std::erase_if(time, [](char c) { return c == '-' || c == ':' || c == 'Z'; });
  std::replace(time.begin(), time.end(), 'T', '-');
  const std::string scene = view.hasScene() ? view.loaded().scene->source().name : "images";
  return fmt::format("{}-{}", safeFileName(scene), time);
}

std::string sessionToml(const ViewFacts& facts, const LiveView& view, const std::string& name) {
  const ViewSettings& settings = view.settings();
  if (!view.hasScene())
    return "# Images of `restlab view`: `restlab view FILE` opens them.\n" + viewToml(view);
  const std::string& title = view.loaded().scene->source().name;
  std::string text =
      "# A session of `restlab view`: `restlab view FILE` opens it, `restlab run FILE` measures "
      "it.\n";
  text += fmt::format("name = {}\n\n", quoted(name));
  text += sceneToml(facts, settings.materials, title.substr(0, title.find('?'))) +
          settingsToml(view) +
          fmt::format("\n[reference]\nspp = {}\n",
                      std::max(kLeastReferenceSpp, view.reference().spp())) +
          cameraToml(view);
  for (const auto& [light, factor] : absoluteLights(settings.lights)) {
    text += fmt::format("\n[[event]]\nframe = 0\nlight = {}\nfactor = {}\n", quoted(light),
                        numberText(factor));
  }
  const std::vector<std::string> names = methodNames(settings);
  for (size_t i = 0; i < names.size(); ++i) text += methodToml(settings.panes[i], names[i]);
  return text + viewToml(view);
}

}  // namespace restlab
