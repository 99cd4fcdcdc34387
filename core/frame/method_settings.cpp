#include "core/frame/method_settings.h"

#include "core/frame/integrator.h"

namespace restlab {

const std::vector<MethodSetting>& methodSettings() {
  static const std::vector<MethodSetting> all = {
      {"integrator", "restlab list integrators (default path)", &SessionConfig::integrator},
      {"mode", "of the integrator (default: its first)", &SessionConfig::mode},
      {"cache", "where reservoirs live: restlab list caches (default pixel)",
       &SessionConfig::cache},
      {"backend", "restlab list backends (default cpu)", &SessionConfig::backend},
      {"denoiser", "restlab list denoisers (default none)", &SessionConfig::denoiser},
  };
  return all;
}

std::string cacheName(const SessionConfig& config) {
  for (const IntegratorInfo* info : integratorRegistry()) {
    if (info->name == config.integrator && info->usesCache) return config.cache;
  }
  return "none";  // also for images of other programs
}

std::vector<std::pair<std::string, std::string>> settingValues(const SessionConfig& config) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const MethodSetting& setting : methodSettings()) {
    const bool isCache = setting.value == &SessionConfig::cache;
    values.emplace_back(setting.key, isCache ? cacheName(config) : config.*setting.value);
  }
  return values;
}

}  // namespace restlab
