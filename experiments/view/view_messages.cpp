#include "experiments/view/view_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/report/pixels.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/registries/registries.h"
#include "experiments/view/page_settings.h"
#include "experiments/view/probe_values.h"
#include "experiments/view/view_exposure.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Replaces invalid UTF-8: names of scenes and devices may hold any bytes.
std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json orNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json intervalJson(const Interval& interval) {
  if (!std::isfinite(interval.value)) return nullptr;
  return {{"value", interval.value}, {"lo", orNull(interval.lo)}, {"hi", orNull(interval.hi)}};
}

// Returns a rigid matrix, as the camera command requires; scale and shear of a node do not affect
// the view.
Json matrixJson(const SceneCamera& camera) {
  glm::dmat4 m = camera.cameraToWorld;
  const glm::dmat3 axes(m);
  const glm::dmat3 deviation = glm::transpose(axes) * axes - glm::dmat3(1.0);
  double largest = 0.0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(deviation[i / 3][i % 3]));
  if (largest > 1e-6) {
    const glm::dvec3 back = glm::normalize(axes[2]);
    const glm::dvec3 right = glm::normalize(axes[0] - glm::dot(axes[0], back) * back);
    m[0] = glm::dvec4(right, 0.0);
    m[1] = glm::dvec4(glm::cross(back, right), 0.0);
    m[2] = glm::dvec4(back, 0.0);
  }
  Json numbers = Json::array();
  for (int i = 0; i < 16; ++i) numbers.push_back(m[i / 4][i % 4]);
  return numbers;
}

Json pointJson(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

std::string kindOfLight(const Scene& scene, const std::string& name) {
  if (name == "environment" || name == "ambient") return name;
  for (const PunctualLight& light : scene.lights) {
    if (light.name != name) continue;
    return light.kind == rl::RL_LIGHT_POINT  ? "point"
           : light.kind == rl::RL_LIGHT_SPOT ? "spot"
                                             : "directional";
  }
  for (const MeshInstance& instance : scene.instances)
    if (instance.name == name) return "mesh";
  return "material";
}

// Names of lights that may get a factor.
std::vector<std::string> namesOfLights(const Scene& scene) {
  std::vector<std::string> names = lightNames(scene);
  if (names.size() > 1) names.insert(names.begin(), kAllLights);
  return names;
}

Json sceneJson(const LiveView& view) {
  if (!view.hasScene()) {
    const std::string& title = view.images().title;
    return {
        {"name", title}, {"title", title}, {"cameras", Json::array()}, {"lights", Json::array()}};
  }
  const Scene& scene = view.loaded().scene->source();
  Json cameras = Json::array(), lights = Json::array();
  for (const SceneCamera& camera : scene.cameras) {
    cameras.push_back(
        {{"name", camera.name}, {"to_world", matrixJson(camera)}, {"yfov", camera.yfov}});
  }
  for (const std::string& name : namesOfLights(scene)) {
    const std::string kind = name == kAllLights ? kAllLights : kindOfLight(scene, name);
    lights.push_back({{"name", name}, {"kind", kind}});
  }
  const auto [lo, hi] = boundsWithoutStrays(scene);
  const bool isBuiltin = isBuiltinScene(scene.name);
  const Session& session = view.session(0);
  return {
      {"name", scene.name},
      {"title", isBuiltin && scene.source.empty() ? builtinSceneSummary(scene.name) : scene.name},
      {"cameras", cameras},
      {"lights", lights},
      {"bounds", {{"lo", pointJson(lo)}, {"hi", pointJson(hi)}}},
      {"feature_lines",
       {std::to_string(view.loaded().scene->instancedTriangleCount()) + " triangles",
        "needs " + featureNames(session.featuresNeeded()),
        "environment " + view.loaded().environmentName}}};
}

// A setting of a page: its description and what it is set to. `why`: why it has no effect.
Json settingJson(const ParameterInfo& info, const ParameterValue& value, bool isSet,
                 const std::string& group, const std::string& why) {
  Json json = parameterJson(info);
  json["part"] = group;
  json["value"] = parameterValueJson(value);
  json["is_set"] = isSet;
  if (!why.empty()) json["unused"] = why;
  return json;
}

Json parametersJson(const LiveView& view, const SessionConfig& config,
                    const std::map<std::string, std::string>& unused) {
  const Method method = findMethod(config);
  const ParameterMap resolved = resolveParameters(method, config.parameters);
  Json all = Json::array();
  for (const auto& [group, summary, info] : groupedParameters(method)) {
    const auto why = unused.find(info.name);
    all.push_back(settingJson(info, resolved.at(info.name), config.parameters.count(info.name) > 0,
                              group, why == unused.end() ? "" : why->second));
    all.back()["part_help"] = summary;
  }
  for (const PageSetting& setting : paneSettings()) {
    ParameterInfo info = setting.info;
    if (info.name == "seed") info.defaultValue = int64_t{view.firstSeed()};
    const ParameterValue value = setting.get(config);
    all.push_back(settingJson(info, value, value != info.defaultValue, setting.group, ""));
  }
  return all;
}

Json sharedJson(const LiveView& view) {
  const std::vector<PaneSettings>& panes = view.settings().panes;
  std::vector<SessionConfig> rendering;
  for (size_t i = 0; i < panes.size(); ++i)
    if (view.renders(i)) rendering.push_back(panes[i].config);
  Json all = Json::array();
  for (const PageSetting& setting : sharedSettings()) {
    const ParameterValue value = sharedValue(setting, panes);
    all.push_back(settingJson(setting.info, value, value != setting.info.defaultValue,
                              setting.group, whyUnused(setting, rendering, *view.shown().scene)));
  }
  return all;
}

// A value of a [[material]]: a number, the text of a choice or a file without quotes, or TOML.
Json materialValue(const ClosureParameter& p, const std::string& toml) {
  if (p.kind == ClosureParameter::Kind::number) return std::strtod(toml.c_str(), nullptr);
  const bool isQuoted = toml.size() > 1 && (toml[0] == '\'' || toml[0] == '"');
  return isQuoted ? toml.substr(1, toml.size() - 2) : toml;
}

// The kind of a material, as a parameter of it.
ClosureParameter kindParameter() {
  ClosureParameter p;
  p.name = "kind";
  p.help = "another kind has other parameters, and the file's own where they are the same";
  p.kind = ClosureParameter::Kind::choice;
  for (const MaterialKind& kind : materialKinds()) p.choices.push_back(kind.name);
  return p;
}

// `own`: what the file has, as TOML.
Json materialParameter(const LiveView& view, const ListedMaterial& of, const ClosureParameter& p,
                       const std::string& own) {
  Json json = {{"name", p.name}, {"help", p.help}};
  json["default"] = materialValue(p, own);
  std::string value = own;
  bool isSet = false;
  const std::string key = materialKey(of.bases, of.material.name, p.name);
  for (const auto& [edited, text] : view.settings().materials) {
    if (edited != key) continue;
    value = text;
    isSet = true;
  }
  if (p.kind == ClosureParameter::Kind::number) {
    json["type"] = "number";
    json["range"] = {p.lo, p.hi};
  }
  if (p.kind == ClosureParameter::Kind::color) {
    json["type"] = "colour";
    json["help"] = fmt::format("{}; from {:g} to {:g}", p.help, p.lo, p.hi);
    json["has_picker"] = p.lo == 0.0 && p.hi == 1.0;
  }
  if (p.kind == ClosureParameter::Kind::choice) json["choices"] = p.choices;
  json["value"] = materialValue(p, value);
  json["is_set"] = isSet;
  return json;
}

// Materials of a scene file and of those that it begins with: kinds and parameters; the default is
// what the file has.
Json materialsJson(const LiveView& view) {
  Json all = Json::array();
  for (const ListedMaterial& listed : view.fileMaterials()) {
    const SceneFileMaterial& material = listed.material;
    // The file may have been edited since it was loaded.
    const std::vector<ListedMaterial>& loaded = view.loadedMaterials();
    const auto same = std::find_if(loaded.begin(), loaded.end(), [&](const ListedMaterial& one) {
      return one.bases == listed.bases && one.material.name == material.name;
    });
    const std::string& loadedKind = (same == loaded.end() ? material : same->material).kind->name;
    Json parameters = Json::array();
    parameters.push_back(materialParameter(view, listed, kindParameter(), loadedKind));
    for (size_t k = 0; k < material.kind->parameters.size(); ++k) {
      parameters.push_back(
          materialParameter(view, listed, material.kind->parameters[k], material.values[k]));
    }
    all.push_back({{"name", material.name},
                   {"bases", listed.bases},
                   {"kind", material.kind->name},
                   {"parameters", parameters}});
  }
  return all;
}

// Layers that every method has; the manual says more of each.
Json layersJson(const SessionConfig& config) {
  Json all = {
      {{"name", "depth"}, {"unit", "m"}, {"help", "distance along the ray"}},
      {{"name", "positionW"}, {"unit", "m"}, {"help", "first hit"}, {"kind", "vector"}},
      {{"name", "normalW"},
       {"unit", ""},
       {"help", "shading normal of the first hit"},
       {"kind", "vector"}},
      {{"name", "albedo"},
       {"unit", ""},
       {"help", "reflectance of the first hit"},
       {"kind", "colour"}},
      {{"name", "object"}, {"unit", ""}, {"help", "number of the mesh"}, {"is_name", true}},
      {{"name", "emission"}, {"unit", ""}, {"help", "light seen directly"}, {"kind", "radiance"}},
      {{"name", "ambient"},
       {"unit", ""},
       {"help", "light from everywhere, without shadows"},
       {"kind", "radiance"}},
      {{"name", "motion"},
       {"unit", "pixels"},
       {"help", "to where it was a frame ago, right and down"},
       {"kind", "vector2"}}};
  for (const LayerInfo* layer : findMethod(config).layers()) {
    all.push_back({{"name", layer->name}, {"unit", layer->unit}, {"help", layer->summary}});
    if (layer->isName) all.back()["is_name"] = true;
  }
  return all;
}

double factorOf(const LightFactors& lights, const std::string& name) {
  double factor = 1.0;
  for (const auto& [light, its] : lights)
    if (light == name) factor = its;
  return factor;
}

Json paneNumbers(const LiveView& view, size_t i) {
  const RunningError& error = view.error(i);
  if (!view.renders(i)) {
    const FileImage* image = view.images().find(view.settings().panes[i].source);
    return {{"frame", 0},
            {"epoch", view.begun(i)},
            {"age", 0},
            {"seen", view.isSeen(i)},
            {"frames_measured", error.frames()},
            {"mse", intervalJson(error.mse())},
            {"relmse", intervalJson(error.relmse())},
            {"energy", intervalJson(error.energyRatio())},
            {"last_mse", nullptr},
            {"ms", image != nullptr && image->ms ? Json(*image->ms) : Json(nullptr)},
            {"passes", Json::array()},
            {"rays", nullptr},
            {"bytes", nullptr},
            {"health", Json::object()}};
  }
  const FrameStats& stats = view.stats(i);
  Json passes = Json::array(), health = Json::object();
  for (const PassTiming& pass : stats.passes)
    passes.push_back({{"name", pass.name}, {"ms", pass.timeMs}});
  for (size_t k = 0; k < stats.health.counts.size(); ++k)
    health[Health::names()[k]] = stats.health.counts[k];
  const SessionConfig& shown = view.shownSession(i).config();
  return {{"frame", view.frames(i)},
          {"epoch", view.begun(i)},
          {"age", view.age(i)},
          {"seen", view.isSeen(i)},
          {"moving", view.isMoving(i)},
          {"width", shown.width},
          {"height", shown.height},
          {"frames_measured", error.frames()},
          {"mse", intervalJson(error.mse())},
          {"relmse", intervalJson(error.relmse())},
          {"energy", intervalJson(error.energyRatio())},
          {"mse_newest", orNull(error.newestMse())},
          {"relmse_newest", orNull(error.newestRelmse())},
          {"old_light", view.hasOldLight(i)},
          {"last_mse", error.frames() > 0 ? orNull(error.lastMse()) : Json(nullptr)},
          {"ms", stats.timeMs},
          {"passes", passes},
          {"rays", stats.raysPath + stats.raysShadow},
          {"bytes", view.shownSession(i).bytesPerPixel() * shown.width * shown.height},
          {"health", health}};
}

}  // namespace

std::string helloText(const ViewFacts& facts, const LiveView& view) {
  Json settings = Json::array();
  for (const MethodSetting& setting : methodSettings())
    if (view.hasScene()) settings.push_back(setting.key);
  Json faults = Json::array();  // counts that must stay 0
  for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i)
    if (isFault(i)) faults.push_back(Health::names()[i]);
  return textOf({{"say", "hello"},
                 {"scene", sceneJson(view)},
                 {"has_scene", view.hasScene()},
                 {"has_reference", view.hasScene() || view.images().reference.has_value()},
                 {"sources", view.sources()},
                 {"tables", view.images().tables},
                 {"integrators", integratorsJson()},
                 {"caches", cachesJson()},
                 {"backends", backendsJson()},
                 {"denoisers", denoisersJson()},
                 {"metrics", metricsJson()},
                 {"settings", settings},
                 {"faults", faults},
                 {"threads", facts.threads},
                 {"warnings", facts.warnings},
                 {"version", buildInfo().version},
                 {"exposure", exposureOf(view)}});
}

std::string stateText(const LiveView& view, const LoopState& loop) {
  const ViewSettings& settings = view.settings();
  Json panes = Json::array(), lights = Json::array();
  for (size_t i = 0; i < settings.panes.size(); ++i) {
    const PaneSettings& pane = settings.panes[i];
    Json json = {{"epoch", view.begun(i)}};
    for (const MethodSetting& setting : methodSettings())
      json[setting.key] = pane.config.*(setting.value);
    json["source"] = pane.source;
    json["layer"] = pane.layer;
    json["layers"] = view.hasScene() ? layersJson(pane.config) : Json::array();
    json["seed"] = pane.config.seed;
    json["parameters"] = Json::array();
    json["unused"] = Json::object();
    if (view.hasScene()) {
      const std::map<std::string, std::string> unused = unusedParameters(pane.config);
      json["parameters"] = parametersJson(view, pane.config, unused);
      if (const auto mode = unused.find("mode"); mode != unused.end())
        json["unused"]["mode"] = mode->second;
    }
    panes.push_back(std::move(json));
  }
  if (view.hasScene()) {
    for (const std::string& name : namesOfLights(view.loaded().scene->source()))
      lights.push_back({{"name", name}, {"factor", factorOf(settings.lights, name)}});
  }
  const SessionConfig& size = settings.panes.front().config;
  const ViewHistory& history = view.history();
  return textOf({{"say", "state"},
                 {"epoch", view.epoch()},
                 {"picture_epoch", view.pictureBegun()},
                 {"panes", panes},
                 {"camera",
                  {{"to_world", matrixJson(settings.camera)},
                   {"yfov", settings.camera.yfov},
                   {"mirrored", settings.camera.isMirrored}}},
                 {"width", size.width},
                 {"height", size.height},
                 {"transport", view.hasScene() ? sharedJson(view) : Json::array()},
                 {"lights", lights},
                 {"materials", view.hasScene() ? materialsJson(view) : Json::array()},
                 {"paused", loop.isPaused},
                 {"adaptive", loop.isAdaptive},
                 {"table", view.images().table},
                 {"exposure", view.hasScene() ? Json(nullptr) : Json(exposureOf(view))},
                 {"can_undo", history.canUndo()},
                 {"can_redo", history.canRedo()},
                 {"undo_text", history.undoText()},
                 {"redo_text", history.redoText()}});
}

std::string numbersText(const LiveView& view, const Transport& transport, double load) {
  Json panes = Json::array();
  std::optional<uint64_t> age;  // of the youngest pane that renders
  for (size_t i = 0; i < view.panes(); ++i) {
    panes.push_back(paneNumbers(view, i));
    if (view.renders(i) && view.isSeen(i)) age = std::min(age.value_or(view.age(i)), view.age(i));
  }
  const LiveReference& reference = view.reference();
  const SessionConfig& size = view.settings().panes.front().config;
  const double sampleMs = reference.sampleMs();
  Json referenceJson = nullptr;  // stays null if there can be no reference
  if (view.hasScene() || reference.hasImage()) {
    referenceJson = {{"spp", reference.spp()},
                     {"relmse", reference.hasImage() ? orNull(reference.relmse()) : Json(nullptr)},
                     {"ms_per_sample", sampleMs > 0.0 ? Json(sampleMs) : Json(nullptr)}};
  }
  return textOf({{"say", "numbers"},
                 {"epoch", view.epoch()},
                 {"age", age.value_or(0)},
                 {"newest_frames", RunningError::kNewest},
                 {"panes", panes},
                 {"nothing_lit", isNothingLit(view)},
                 {"reference", referenceJson},
                 {"transport",
                  {{"width", size.width},
                   {"height", size.height},
                   {"bits", transport.format == PixelFormat::halves ? 16 : 32},
                   {"mb_per_second", transport.megabytesPerSecond}}},
                 {"busy", orNull(load)}});
}

std::string probeText(const ViewFacts& facts, const LiveView& view, const Probe& probe) {
  if (probe.pane >= view.panes())
    failUsage("probe: there are " + std::to_string(view.panes()) + " panes");
  if (!view.renders(probe.pane))
    failUsage("probe: the pane shows no method, which alone keeps something of a pixel");
  if (view.frames(probe.pane) == 0) failUsage("probe: no frame was rendered yet");
  const SessionConfig& config = view.settings().panes[probe.pane].config;
  return textOf({{"say", "probe"},
                 {"pane", probe.pane},
                 {"x", probe.x},
                 {"y", probe.y},
                 {"frame", view.frames(probe.pane)},
                 {"epoch", view.epochOf(probe.pane)},
                 {"seed", config.seed},
                 {"values", probedValuesJson(view.session(probe.pane), probe.x, probe.y)},
                 {"path", probedPathJson(view.session(probe.pane), probe.x, probe.y)},
                 {"donors", probedDonorsJson(view.session(probe.pane), probe.x, probe.y)},
                 {"command", probeCommand(facts, view, probe)}});
}

std::string errorText(const std::string& line, const std::string& command) {
  return textOf({{"say", "error"},
                 {"text", line},
                 {"command", command.empty() ? Json(nullptr) : Json(command)}});
}

std::string progressText(size_t pane, uint64_t frame, double fraction) {
  return textOf({{"say", "progress"}, {"pane", pane}, {"frame", frame}, {"fraction", fraction}});
}

std::string preparingText() { return textOf({{"say", "progress"}, {"pane", nullptr}}); }

std::string saidText(const std::string& line) { return textOf({{"say", "said"}, {"text", line}}); }

std::string savedText(const std::string& name, const std::string& toml) {
  return textOf({{"say", "saved"}, {"name", name}, {"toml", toml}});
}

std::string measureText(const Measurement& measurement) {
  static const std::map<Measurement::State, const char*> names = {
      {Measurement::State::none, "none"},
      {Measurement::State::running, "running"},
      {Measurement::State::finished, "finished"},
      {Measurement::State::failed, "failed"},
      {Measurement::State::cancelled, "cancelled"}};
  Json rows = Json::array();
  for (const MeasuredRow& row : measurement.rows()) {
    rows.push_back({{"method", row.method},
                    {"runs", row.runs},
                    {"mse", orNull(row.mse)},
                    {"relmse", orNull(row.relmse)},
                    {"energy", orNull(row.energy)},
                    {"ms", orNull(row.timeMs)}});
  }
  return textOf({{"say", "measure"},
                 {"state", names.at(measurement.state())},
                 {"text", measurement.text()},
                 {"done", measurement.done()},
                 {"suite", measurement.suite()},
                 {"folder", measurement.out()},
                 {"rows", rows}});
}

std::string fileText(const std::string& name, const std::string& bytes) {
  return textOf({{"say", "file"}, {"name", name}, {"base64", encodeBase64(bytes)}});
}

}  // namespace restlab
