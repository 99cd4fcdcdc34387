#include "experiments/view/page_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/reuse/settings.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/view/view_settings.h"

namespace restlab {

namespace {

constexpr const char* kBestRayTracing = "best";
constexpr const char* kOfPicture = "light that is shown";
constexpr const char* kOfTransport = "light transport";
constexpr const char* kOfMachine = "machine";
constexpr double kMostThreads = 1024.0;

bool isVulkan(const SessionConfig& config) { return config.backend == "vulkan"; }

ParameterInfo described(const char* name, ParameterValue value, const char* help) {
  ParameterInfo info;
  info.name = name;
  info.defaultValue = std::move(value);
  info.help = help;
  return info;
}

PageSetting componentSetting() {
  PageSetting s{described("component", componentName(rl::RL_COMPONENT_ALL),
                          "direct: of at most one scattering event; indirect: of more; also of the "
                          "reference"),
                kOfPicture, [](const SessionConfig& c) { return componentName(c.components); },
                [](SessionConfig& c, const ParameterValue& value) {
                  c.components = parseComponent(std::get<std::string>(value), "component");
                }};
  for (const uint32_t light :
       {rl::RL_COMPONENT_ALL, rl::RL_COMPONENT_DIRECT, rl::RL_COMPONENT_INDIRECT})
    s.info.choices.push_back(componentName(light));
  return s;
}

std::vector<PageSetting> transportSettings() {
  std::vector<PageSetting> all;
  for (const ParameterInfo& info : transportSchema().infos()) {
    const auto get = [name = info.name](const SessionConfig& config) {
      const std::vector<ParameterInfo> own = transportSchema().infos(config);
      return std::find_if(own.begin(), own.end(),
                          [&](const ParameterInfo& one) { return one.name == name; })
          ->defaultValue;
    };
    const auto set = [name = info.name](SessionConfig& config, const ParameterValue& value) {
      transportSchema().assign(config, {{name, value}});
    };
    all.push_back({info, kOfTransport, get, set});
  }
  return all;
}

PageSetting rayTracingSetting() {
  PageSetting s{described("ray_tracing", std::string(kBestRayTracing),
                          "of the panes whose backend has it; best: the backend's own choice"),
                kOfMachine,
                [](const SessionConfig& c) {
                  return c.rayTracing.empty() ? std::string(kBestRayTracing) : c.rayTracing;
                },
                [](SessionConfig& c, const ParameterValue& value) {
                  const std::string& name = std::get<std::string>(value);
                  c.rayTracing = mayTraceBy(c.backend, name) ? name : "";
                }};
  s.info.choices = rayTracingNames();
  s.info.choices.insert(s.info.choices.begin(), kBestRayTracing);
  return s;
}

PageSetting threadsSetting() {
  PageSetting s{
      described("threads", int64_t{0}, "of the CPU, also for the reference; 0: all cores"),
      kOfMachine, [](const SessionConfig& c) { return int64_t{c.threads}; },
      [](SessionConfig& c, const ParameterValue& value) {
        c.threads = int(std::get<int64_t>(value));
      }};
  s.info.maxValue = kMostThreads;
  return s;
}

PageSetting kernelsSetting() {
  PageSetting s{described("kernels", kernelChoiceName(defaultKernelChoice()),
                          "exact: compiled for the features of the scene; built-in: the smallest "
                          "that came with the program; general: with all features"),
                kOfMachine, [](const SessionConfig& c) { return kernelChoiceName(c.kernels); },
                [](SessionConfig& c, const ParameterValue& value) {
                  c.kernels = parseKernelChoice(std::get<std::string>(value), "kernels");
                }};
  s.info.choices = kernelChoiceNames();
  return s;
}

PageSetting seedSetting() {
  PageSetting s{described("seed", int64_t{SessionConfig{}.seed},
                          "of the random numbers; a restart takes the next one"),
                kOfMachine, [](const SessionConfig& c) { return int64_t{c.seed}; },
                [](SessionConfig& c, const ParameterValue& value) {
                  c.seed = uint32_t(std::get<int64_t>(value));
                }};
  s.info.maxValue = double(~uint32_t{0});
  return s;
}

// Reason of a setting of light transport in the pane's method; "" if it has an effect.
std::string whyUnusedByMethod(const std::string& name, const SessionConfig& pane) {
  const Method method = findMethod(pane);
  const ParameterMap resolved = resolveParameters(method, pane.parameters);
  for (const PartInfo* part : method.parts()) {
    const std::string why = part->reasonUnused ? part->reasonUnused(name, resolved) : "";
    if (!why.empty()) return why;
  }
  return "";
}

}  // namespace

const std::vector<PageSetting>& sharedSettings() {
  static const std::vector<PageSetting> settings = [] {
    std::vector<PageSetting> all = {componentSetting()};
    for (PageSetting& one : transportSettings()) all.push_back(std::move(one));
    all.push_back(threadsSetting());
    all.push_back(rayTracingSetting());
    all.push_back({described("device", std::string(), "a part of a Vulkan device's name"),
                   kOfMachine, [](const SessionConfig& c) { return c.device; },
                   [](SessionConfig& c, const ParameterValue& value) {
                     c.device = isVulkan(c) ? std::get<std::string>(value) : "";
                   }});
    all.push_back({described("validate", false, "Vulkan's validation layers (slow)"), kOfMachine,
                   [](const SessionConfig& c) { return c.validate; },
                   [](SessionConfig& c, const ParameterValue& value) {
                     c.validate = isVulkan(c) && std::get<bool>(value);
                   }});
    return all;
  }();
  return settings;
}

const std::vector<PageSetting>& paneSettings() {
  static const std::vector<PageSetting> settings = {kernelsSetting(), seedSetting()};
  return settings;
}

ParameterValue sharedValue(const PageSetting& setting, const std::vector<PaneSettings>& panes) {
  for (const PaneSettings& pane : panes)
    if (setting.get(pane.config) != setting.info.defaultValue) return setting.get(pane.config);
  return setting.info.defaultValue;
}

std::string whyUnused(const PageSetting& setting, const std::vector<SessionConfig>& panes,
                      const CompiledScene& scene) {
  const std::string& name = setting.info.name;
  const auto all = [&](const auto& holds) {
    return std::all_of(panes.begin(), panes.end(), holds);
  };
  if ((name == "device" || name == "validate") &&
      all([](const SessionConfig& c) { return !isVulkan(c); }))
    return "no pane has the backend vulkan";
  if (name == "multiscatter" && (scene.features(true) & rl::RL_FEATURE_MULTISCATTER) == 0)
    return "the scene has no rough reflection";
  if (name == "light_choice" && scene.lampCount() < 2) return "the scene has less than two lamps";
  if (!setting.info.sameMean) return "";  // the reference has it
  if (name == "russian_roulette" && all([](const SessionConfig& c) {
        const bool isDirect = (c.components & rl::RL_COMPONENT_INDIRECT) == 0;
        return (isDirect ? 1u : c.maxBounces) < rl::RL_ROULETTE_EARLIEST;
      }))
    return fmt::format("no path has {} scattering events", rl::RL_ROULETTE_EARLIEST);
  if (panes.empty()) return "no pane shows a method";
  std::string reason;
  for (const SessionConfig& pane : panes) {
    const std::string why = whyUnusedByMethod(name, pane);
    if (why.empty()) return "";
    if (reason.find(why) == std::string::npos) reason += (reason.empty() ? "" : "; ") + why;
  }
  return reason;
}

std::map<std::string, std::string> unusedParameters(const SessionConfig& pane) {
  const Method method = findMethod(pane);
  const std::vector<ModeInfo>& modes = method.integrator->modes;
  std::map<std::string, std::string> reasons;
  const ParameterMap resolved = resolveParameters(method, pane.parameters);
  for (const auto& [name, why] : settingsWithoutEffect(method, modes.back().name, resolved))
    reasons[name] = why;
  if (modes.size() == 1) reasons.erase("mode");
  return reasons;
}

std::vector<GroupedParameter> groupedParameters(const Method& method) {
  const std::vector<const PartInfo*> parts = method.parts();
  const std::vector<ParameterInfo> infos = method.parameters();
  std::set<std::string> ofReuse;
  for (const ParameterInfo& info : reuseParameters()) ofReuse.insert(info.name);
  std::vector<std::pair<size_t, GroupedParameter>> all;  // with their rank
  size_t next = 0;  // parameters() lists the parameters of each part, in the order of parts()
  for (size_t i = 0; i < parts.size(); ++i) {
    for (size_t k = 0; k < parts[i]->parameters.size(); ++k) {
      const ParameterInfo& info = infos.at(next++);
      const bool isReuse = parts[i] == method.integrator && ofReuse.count(info.name) > 0;
      const size_t rank = isReuse                         ? 1
                          : parts[i] == method.integrator ? 0
                          : parts[i] == method.cache      ? 2
                          : parts[i] == method.denoiser   ? 3
                                                          : 3 + parts.size() - i;
      const std::string reuse = "reuse of samples over time and space";
      all.push_back({rank, isReuse ? GroupedParameter{"reuse", reuse, info}
                                   : GroupedParameter{parts[i]->name, parts[i]->summary, info}});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<GroupedParameter> sorted;
  for (auto& [rank, one] : all) sorted.push_back(std::move(one));
  return sorted;
}

}  // namespace restlab
