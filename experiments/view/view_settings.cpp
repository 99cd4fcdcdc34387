#include "experiments/view/view_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/frame/session.h"
#include "core/scene/compiled/light_factor.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/runner/suite/prepare.h"
#include "experiments/view/page_settings.h"

namespace restlab {

namespace {

constexpr const char* kKindKey = "kind";

// Keeps the parameters that the new method has, too.
ParameterMap parametersFor(const SessionConfig& config) {
  ParameterMap kept;
  for (const ParameterInfo& info : findMethod(config).parameters()) {
    const auto found = config.parameters.find(info.name);
    if (found != config.parameters.end()) kept.insert(*found);
  }
  return kept;
}

// Converts a whole number to a real parameter.
ParameterValue valueFor(const ParameterInfo& info, const ParameterValue& value) {
  const int64_t* whole = std::get_if<int64_t>(&value);
  if (whole && std::holds_alternative<double>(info.defaultValue)) return double(*whole);
  return value;
}

bool hasLayer(const SessionConfig& config, const std::string& name) {
  const std::vector<std::string> names = findMethod(config).aovNames();
  return name.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

// Returns the description of that name, or null.
template <class All, class NameOf>
auto* findNamed(All& all, const std::string& name, const NameOf& nameOf) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return nameOf(one) == name; });
  return found == all.end() ? nullptr : &*found;
}
const PageSetting* findSetting(const std::vector<PageSetting>& all, const std::string& name) {
  return findNamed(all, name, [](const PageSetting& one) { return one.info.name; });
}

std::vector<std::string> namesOf(const std::vector<PageSetting>& all) {
  std::vector<std::string> names;
  for (const PageSetting& one : all) names.push_back(one.info.name);
  return names;
}

char letterOf(uint32_t pane) { return char('A' + int(pane)); }

// True if both have the same position, viewing axis and up side.
bool isSamePlace(const glm::dmat4& a, const glm::dmat4& b) {
  constexpr double kClose = 1e-9;
  const glm::dvec3 apart(a[3] - b[3]);
  if (glm::length(apart) > kClose * (1.0 + glm::length(glm::dvec3(a[3])))) return false;
  for (const int axis : {1, 2}) {
    const glm::dvec3 was = glm::normalize(glm::dvec3(a[axis]));
    const double least = axis == 2 ? 1.0 - kClose : 0.5;  // sheared axes need not be orthogonal
    if (glm::dot(was, glm::normalize(glm::dvec3(b[axis]))) < least) return false;
  }
  return true;
}

// Changes settings in place and describes the change in words.
struct Change {
  ViewSettings& settings;
  const ViewChoices& choices;
  std::string text = {};

  PaneSettings& paneOf(uint32_t index) {
    if (index >= settings.panes.size())
      failUsage(fmt::format("pane {}: there are {}", index, settings.panes.size()));
    return settings.panes[index];
  }

  // Drop the parameters and the layer that the new method does not have.
  void setMethod(PaneSettings& pane, SessionConfig config) {
    config.parameters = parametersFor(config);
    pane.config = withNames(std::move(config));
    if (!hasLayer(pane.config, pane.layer)) pane.layer.clear();
  }

  void setSource(uint32_t index, const std::string& source) {
    const std::vector<std::string>& known = choices.sources;
    if (std::find(known.begin(), known.end(), source) == known.end()) {
      failUsage(fmt::format("pane {}: '{}' is nothing that it can show (known: '{}'){}", index,
                            source, fmt::join(known, "', '"), didYouMean(source, known)));
    }
    paneOf(index).source = source;
    text = fmt::format("{}: {}", letterOf(index), source.empty() ? "method" : source);
  }

  void operator()(const SetSetting& command) {
    if (command.key == "source") return setSource(command.pane, command.value);
    PaneSettings& pane = paneOf(command.pane);
    SessionConfig config = pane.config;
    const std::vector<MethodSetting>& all = methodSettings();
    const auto setting = std::find_if(all.begin(), all.end(),
                                      [&](const MethodSetting& s) { return s.key == command.key; });
    if (setting == all.end()) {
      std::vector<std::string> keys;
      for (const MethodSetting& s : all) keys.emplace_back(s.key);
      failUsage(fmt::format("'{}': is no setting of a method (known: {}){}", command.key,
                            fmt::join(keys, ", "), didYouMean(command.key, keys)));
    }
    config.*(setting->value) = command.value;
    // Another backend gets what is set for it.
    for (const PageSetting& shared : sharedSettings())
      shared.set(config, sharedValue(shared, settings.panes));
    // Reset mode and cache: they belong to the integrator.
    if (setting->value == &SessionConfig::integrator) config.mode = config.cache = "";
    setMethod(pane, std::move(config));
    text = fmt::format("{}: {} {}", letterOf(command.pane), command.key, command.value);
  }

  void setOfPane(const SetParameter& command, const PageSetting& setting) {
    PaneSettings& pane = paneOf(command.pane);
    const bool isSeed = setting.info.name == "seed";
    const ParameterValue fallback =
        isSeed ? ParameterValue(int64_t{choices.firstSeed}) : setting.info.defaultValue;
    const ParameterValue value =
        checkedValue("pane", setting.info, command.value.value_or(fallback));
    if (setting.get(pane.config) == value) return;
    setting.set(pane.config, value);
    if (isSeed) ++pane.seedsSet;
    text = fmt::format("{}: {} {}", letterOf(command.pane), command.name, settingText(value));
  }

  void operator()(const SetParameter& command) {
    PaneSettings& pane = paneOf(command.pane);
    if (const PageSetting* own = findSetting(paneSettings(), command.name))
      return setOfPane(command, *own);
    const Method method = findMethod(pane.config);
    const std::vector<ParameterInfo> known = method.parameters();
    const ParameterInfo* info =
        findNamed(known, command.name, [](const ParameterInfo& p) { return p.name; });
    if (info == nullptr) {
      std::vector<std::string> names = namesOf(paneSettings());
      for (const ParameterInfo& p : known) names.push_back(p.name);
      failUsage(fmt::format("pane {}: has no parameter '{}'{}", command.pane, command.name,
                            didYouMean(command.name, names)));
    }
    ParameterMap& parameters = pane.config.parameters;
    if (command.value) {
      parameters[command.name] = valueFor(*info, *command.value);
    } else {
      parameters.erase(command.name);
    }
    const ParameterValue value = resolveParameters(method, parameters).at(command.name);
    text = fmt::format("{}: {} = {}", letterOf(command.pane), command.name, parameterText(value));
  }

  // Takes mirroring and shift, which a page does not know, from the scene's camera at the place.
  // Among several there, one with the same angle is meant.
  void takeUnsaid(const SceneCamera& before, SceneCamera& camera) const {
    const bool isMoved = !isSamePlace(before.cameraToWorld, camera.cameraToWorld);
    if (!isMoved && before.yfov == camera.yfov) return;
    const SceneCamera* meant = nullptr;
    for (const SceneCamera& known : choices.scene->cameras) {
      if (!isSamePlace(known.cameraToWorld, camera.cameraToWorld)) continue;
      const bool hasAngle = known.yfov == camera.yfov;
      if (hasAngle || (isMoved && !meant)) meant = &known;
      if (hasAngle) break;
    }
    if (!meant) return;
    camera.isMirrored = meant->isMirrored;
    camera.shift = meant->shift;
  }

  void operator()(const MoveCamera& command) {
    SceneCamera& camera = settings.camera;
    const SceneCamera before = camera;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row)
        camera.cameraToWorld[column][row] = command.toWorld[size_t(4 * column + row)];
    }
    if (command.yfov) camera.yfov = *command.yfov;
    takeUnsaid(before, camera);
    text = "camera";
  }

  void operator()(const Resize& command) {
    for (PaneSettings& pane : settings.panes) {
      pane.config.width = command.width;
      pane.config.height = command.height;
    }
    text = fmt::format("{}x{}", command.width, command.height);
  }

  void operator()(const SetTransport& command) {
    const PageSetting* setting = findSetting(sharedSettings(), command.name);
    if (setting == nullptr) {
      const std::vector<std::string> names = namesOf(sharedSettings());
      failUsage(fmt::format("'{}': is no setting of all panes (known: {}){}", command.name,
                            fmt::join(names, ", "), didYouMean(command.name, names)));
    }
    const ParameterInfo& info = setting->info;
    const ParameterValue value =
        checkedValue("transport", info, command.value.value_or(info.defaultValue));
    for (PaneSettings& pane : settings.panes) setting->set(pane.config, value);
    text = fmt::format("{} {}", info.name, settingText(value));
    if (sharedValue(*setting, settings.panes) != value)
      failUsage(fmt::format("{}: is nothing for the backend of any pane", text));
  }

  void operator()(const SetLight& command) {
    requireLight(*choices.scene, command.name);
    setLight(settings.lights, command.name, command.factor);
    text = fmt::format("{} x{:g}", command.name, command.factor);
  }

  void operator()(const SetMaterial& command) {
    if (!isSceneFile(choices.scene->source))
      failUsage("material: the scene is no NAME.scene.toml, whose materials can be set");
    const std::string key = materialKey(command.bases, command.name, command.key);
    if ((key + command.value.value_or("")).find('&') != std::string::npos ||
        key.find('=') != std::string::npos)
      failUsage(fmt::format("{}: settings behind the name of a scene have no '&' or '='", key));
    // Another kind has other parameters.
    const bool isKind = command.key == kKindKey;
    const std::string replaced = isKind ? materialKey(command.bases, command.name, "") : key;
    std::erase_if(settings.materials, [&](const auto& edit) {
      return isKind ? edit.first.starts_with(replaced) : edit.first == replaced;
    });
    if (command.value) settings.materials.emplace_back(key, *command.value);
    text = fmt::format("{}: {} {}", command.name, command.key,
                       command.value ? "= " + *command.value : "as in the file");
  }

  void operator()(const ShowLayer& command) {
    PaneSettings& pane = paneOf(command.pane);
    if (!hasLayer(pane.config, command.name)) {
      const std::vector<std::string> names = findMethod(pane.config).aovNames();
      failUsage(fmt::format("layer '{}': is unknown (known: {}){}", command.name,
                            fmt::join(names, ", "), didYouMean(command.name, names)));
    }
    pane.layer = command.name;
    text = fmt::format("{}: layer {}", letterOf(command.pane),
                       command.name.empty() ? "none" : command.name);
  }

  void operator()(const CopyMethod& command) {
    const PaneSettings from = paneOf(command.from);
    PaneSettings& pane = paneOf(command.to);
    pane.source = from.source;
    SessionConfig config = from.config;
    config.seed = pane.config.seed;
    setMethod(pane, std::move(config));
    text = fmt::format("{}: as {}", letterOf(command.to), letterOf(command.from));
  }

  template <class Other>
  void operator()(const Other&) {
    throw std::logic_error("the command sets nothing");
  }
};

struct Target {
  std::string operator()(const SetParameter& c) {
    return fmt::format("parameter {} {}", c.pane, c.name);
  }
  std::string operator()(const MoveCamera&) { return "camera"; }
  std::string operator()(const Resize&) { return "resolution"; }
  std::string operator()(const SetTransport& c) { return "transport " + c.name; }
  std::string operator()(const SetLight& c) { return "light " + c.name; }
  std::string operator()(const SetMaterial& c) {
    return fmt::format("material {} {}.{}", c.bases, c.name, c.key);
  }
  std::string operator()(const ShowTable&) { return "table"; }
  template <class Other>
  std::string operator()(const Other&) {
    return "";
  }
};

}  // namespace

std::string targetOf(const ViewCommand& command) { return std::visit(Target{}, command); }

std::vector<ListedMaterial> materialsOf(const PreparedScene& loaded, const MaterialEdits& edits) {
  const Scene& scene = loaded.scene->source();
  if (!isSceneFile(scene.source)) return {};
  MaterialEdits kinds;
  const std::string end = std::string(".") + kKindKey;
  for (const auto& edit : edits)
    if (edit.first.ends_with(end)) kinds.push_back(edit);
  return listMaterials(scene.source, joinedSettings(settingsOfScene(scene), settingsText(kinds)));
}

std::string settingsText(const MaterialEdits& edits) {
  std::string text;
  for (const auto& [key, value] : edits)
    text += fmt::format("{}{}={}", text.empty() ? "" : "&", key, value);
  return text;
}

void setLight(LightFactors& lights, const std::string& name, double factor) {
  std::erase_if(lights, [&](const auto& light) { return light.first == name; });
  // A mesh and its material may both have a factor, and the last one counts: keep a factor of 1
  // then.
  const bool isAlone = name == kAllLights ||
                       std::all_of(lights.begin(), lights.end(),
                                   [](const auto& light) { return light.first == kAllLights; });
  if (factor != 1.0 || !isAlone) lights.emplace_back(name, factor);
}

LightFactors absoluteLights(const LightFactors& lights) {
  const auto all = std::find_if(lights.begin(), lights.end(),
                                [](const auto& light) { return light.first == kAllLights; });
  if (all == lights.end()) return lights;
  LightFactors absolute = {*all};
  for (const auto& [name, factor] : lights)
    if (name != kAllLights) absolute.emplace_back(name, factor * all->second);
  return absolute;
}

LightFactors ownLights(const LightFactors& absolute, const Scene& scene) {
  double all = 1.0;
  LightFactors own;
  for (const auto& [name, factor] : absolute) {
    if (name == kAllLights) {
      all = factor;
      own.clear();
    } else {
      setLight(own, name, factor);
    }
  }
  // No factor on 0 gives a light again: switch each light off by itself instead.
  const bool isOff = all == 0.0 && std::any_of(own.begin(), own.end(), [](const auto& light) {
                       return light.second != 0.0;
                     });
  LightFactors lights;
  if (isOff) {
    for (const std::string& name : lightNames(scene)) setLight(lights, name, 0.0);
  } else {
    setLight(lights, kAllLights, all);
  }
  if (all == 0.0 && !isOff) return lights;
  for (const auto& [name, factor] : own) setLight(lights, name, isOff ? factor : factor / all);
  return lights;
}

ViewChange changedBy(const ViewCommand& command, const ViewSettings& settings,
                     const ViewChoices& choices) {
  if (choices.scene == nullptr)
    failUsage("images of files are shown, and nothing is rendered: there is nothing to change");
  ViewChange result{settings, targetOf(command), ""};
  Change change{result.settings, choices};
  std::visit(change, command);
  result.text = change.text;
  return result;
}

SessionConfig withNames(SessionConfig config) {
  const Method method = findMethod(config);
  config.mode = findMode(*method.integrator, config.mode);
  if (method.cache != nullptr) config.cache = method.cache->name;
  return config;
}

bool isSameMethod(const SessionConfig& a, const SessionConfig& b) {
  const auto of = [](const SessionConfig& c) {
    return std::tie(c.integrator, c.mode, c.cache, c.backend, c.device, c.rayTracing, c.validate,
                    c.denoiser, c.camera, c.components, c.kernels, c.threads);
  };
  return of(a) == of(b) && static_cast<const TransportSettings&>(a) == b;
}

bool isSameSize(const SessionConfig& a, const SessionConfig& b) {
  return a.width == b.width && a.height == b.height;
}

bool isSameCamera(const SceneCamera& a, const SceneCamera& b) {
  return a.kind == b.kind && a.cameraToWorld == b.cameraToWorld && a.isMirrored == b.isMirrored &&
         a.yfov == b.yfov && a.xmag == b.xmag && a.ymag == b.ymag && a.shift == b.shift;
}

bool isSamePicture(const ViewSettings& a, const ViewSettings& b) {
  return a.lights == b.lights && a.materials == b.materials && isSameCamera(a.camera, b.camera) &&
         isSameSize(a.panes.front().config, b.panes.front().config) &&
         a.panes.front().config.components == b.panes.front().config.components &&
         referenceTransport(a.panes.front().config) == referenceTransport(b.panes.front().config);
}

bool isSame(const ViewSettings& a, const ViewSettings& b) {
  const auto isSamePane = [](const PaneSettings& x, const PaneSettings& y) {
    return isSameMethod(x.config, y.config) && x.config.parameters == y.config.parameters &&
           x.layer == y.layer && x.source == y.source && x.seedsSet == y.seedsSet;
  };
  return isSamePicture(a, b) &&
         std::equal(a.panes.begin(), a.panes.end(), b.panes.begin(), b.panes.end(), isSamePane);
}

}  // namespace restlab
