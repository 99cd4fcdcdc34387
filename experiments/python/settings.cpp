#include "experiments/python/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/backend/backend.h"
#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "experiments/python/call.h"
#include "experiments/python/values.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

constexpr double kMostEnvironment = 1e9;

// One keyword: its type and range, and where its value goes.
struct Keyword {
  ParameterInfo info;
  std::function<void(Settings&, const ParameterValue&)> set;
};

template <class Set>
Keyword keyword(const char* name, ParameterValue like, Set set, double lo = 0.0, double hi = 0.0) {
  Keyword word;
  word.info.name = name;
  word.info.defaultValue = std::move(like);
  word.info.minValue = lo;
  word.info.maxValue = hi;
  word.set = [set](Settings& settings, const ParameterValue& value) { set(settings, value); };
  return word;
}

Keyword whole(const char* name, double lo, double hi, uint32_t SessionConfig::*member) {
  return keyword(
      name, int64_t{0},
      [member](Settings& settings, const ParameterValue& value) {
        settings.config.*member = uint32_t(std::get<int64_t>(value));
      },
      lo, hi);
}

Keyword text(const char* name, std::string SessionConfig::*member) {
  return keyword(name, std::string(), [member](Settings& settings, const ParameterValue& value) {
    settings.config.*member = std::get<std::string>(value);
  });
}

Keyword number(const char* name, double lo, double hi,
               std::optional<double> SceneRequest::*member) {
  return keyword(
      name, 0.0,
      [member](Settings& settings, const ParameterValue& value) {
        settings.request.*member = std::get<double>(value);
      },
      lo, hi);
}

std::vector<Keyword> keywords() {
  std::vector<Keyword> all;
  for (const MethodSetting& setting : methodSettings())
    all.push_back(text(setting.key, setting.value));
  all.push_back(text("device", &SessionConfig::device));
  all.push_back(text("ray_tracing", &SessionConfig::rayTracing));
  all.push_back(keyword("validate", false, [](Settings& settings, const ParameterValue& value) {
    settings.config.validate = std::get<bool>(value);
  }));
  all.push_back(keyword("kernels", std::string(), [](Settings& s, const ParameterValue& value) {
    s.config.kernels = parseKernelChoice(std::get<std::string>(value), "kernels");
  }));
  all.push_back(keyword("component", std::string(), [](Settings& s, const ParameterValue& value) {
    s.config.components = parseComponent(std::get<std::string>(value), "component");
  }));
  all.push_back(keyword(
      "threads", int64_t{0},
      [](Settings& settings, const ParameterValue& value) {
        settings.config.threads = int(std::get<int64_t>(value));
      },
      0.0, 1024.0));
  all.push_back(whole("width", 1.0, kMaxSide, &SessionConfig::width));
  all.push_back(whole("height", 1.0, kMaxSide, &SessionConfig::height));
  all.push_back(whole("seed", 0.0, double(~uint32_t{0}), &SessionConfig::seed));
  all.push_back(number("environment_rotation", -360.0, 360.0, &SceneRequest::environmentRotation));
  all.push_back(
      number("environment_scale", 0.0, kMostEnvironment, &SceneRequest::environmentScale));
  for (const ParameterInfo& info : transportSchema().infos()) {
    all.push_back({info, [name = info.name](Settings& settings, const ParameterValue& value) {
                     transportSchema().assign(settings.config, {{name, value}});
                     settings.hasBounces = settings.hasBounces || name == "max_bounces";
                   }});
  }
  return all;
}

// Fails if no part of the method has the parameter; names keywords, too, as it may be one.
void requireKnown(const Method& method, const ParameterMap& parameters,
                  const std::vector<Keyword>& known) {
  std::vector<std::string> names = {"camera", "environment"};
  for (const ParameterInfo& info : method.parameters()) names.push_back(info.name);
  const size_t own = names.size();
  for (const Keyword& word : known) names.push_back(word.info.name);
  for (const auto& [name, value] : parameters) {
    if (std::find(names.begin() + 2, names.begin() + std::ptrdiff_t(own), name) !=
        names.begin() + std::ptrdiff_t(own))
      continue;
    failUsage(fmt::format(
        "'{}': is no setting, and no parameter of integrator {}{}{}", name, method.integrator->name,
        method.denoiser->parameters.empty() ? "" : " with denoiser " + method.denoiser->name,
        didYouMean(name, names)));
  }
}

void checkDevice(const SessionConfig& config) {
  const auto requireAmong = [](const char* name, const std::string& value,
                               const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), value) != known.end()) return;
    failUsage(fmt::format("{} '{}': is unknown (known: {}){}", name, value, fmt::join(known, ", "),
                          didYouMean(value, known)));
  };
  requireAmong("backend", config.backend, backendNames());
  if (!config.rayTracing.empty()) requireAmong("ray_tracing", config.rayTracing, rayTracingNames());
  if (config.backend == "vulkan") useVulkan();
  if (config.backend != "cpu") return;
  if (!config.device.empty())
    failUsage(fmt::format("device '{}': only backend='vulkan' has devices to choose from",
                          config.device));
  if (config.validate) failUsage("validate: is of backend='vulkan' alone");
}

}  // namespace

ParameterMap parametersOf(const py::dict& given) {
  ParameterMap parameters;
  for (const auto& [key, value] : given) {
    const std::string name = py::str(key);
    parameters[name] = valueOf(value, name);
  }
  return parameters;
}

Settings settingsOf(const py::handle& scene, const py::kwargs& given) {
  Settings settings;
  settings.config.width = settings.config.height = 0;
  settings.request.scene = textOf(scene, "scene");
  const std::vector<Keyword> known = keywords();
  for (const auto& [key, value] : given) {
    const std::string name = py::str(key);
    if (value.is_none()) continue;
    if (name == "environment") {
      settings.request.environment = textOf(value, name);
    } else if (name == "camera") {
      settings.request.camera = nameOrIndexOf(value, name);
    } else {
      const auto found = std::find_if(known.begin(), known.end(),
                                      [&](const Keyword& word) { return word.info.name == name; });
      const ParameterValue typed = valueOf(value, name);
      if (found == known.end()) {
        settings.config.parameters[name] = typed;
      } else {
        found->set(settings, checkedValue("settings", found->info, typed));
      }
    }
  }
  SessionConfig& config = settings.config;
  const Method method = findMethod(config);
  config.mode = findMode(*method.integrator, config.mode);
  checkDevice(config);
  requireKnown(method, config.parameters, known);
  for (const auto& [name, why] : settingsWithoutEffect(method, config.mode, config.parameters))
    logWarning(fmt::format("{} has no effect: {}", name, why));
  return settings;
}

PreparedScene prepare(Settings& settings) {
  PreparedScene prepared = prepareScene(settings.request);
  printWarnings(prepared);
  SessionConfig& config = settings.config;
  const std::optional<uint32_t>& bounces = prepared.scene->source().maxBounces;
  if (bounces && !settings.hasBounces) config.maxBounces = *bounces;
  config.camera = prepared.camera;
  completeResolution(prepared, config.width, config.height);
  return prepared;
}

py::dict settingsDict(const SessionConfig& config) {
  py::dict all;
  for (const auto& [key, value] : settingValues(config)) all[strOf(key)] = strOf(value);
  all["kernels"] = kernelChoiceName(config.kernels);
  all["component"] = componentName(config.components);
  all["threads"] = config.threads;
  all["width"] = config.width;
  all["height"] = config.height;
  all["seed"] = config.seed;
  // Its defaults are those of the configuration.
  for (const ParameterInfo& info : transportSchema().infos(config))
    all[strOf(info.name)] = objectOf(info.defaultValue);
  return all;
}

}  // namespace restlab::python
