#include "core/frame/method_settings.h"

#include <fmt/format.h>

#include <algorithm>

namespace restlab {

namespace {

// Parameters of a method that has that part alone, whose own come first.
std::vector<ParameterInfo> ownFirst(const Method& alone, const PartInfo& part) {
  std::vector<ParameterInfo> all = alone.parameters();
  std::stable_partition(all.begin(), all.end(), [&](const ParameterInfo& info) {
    return std::any_of(part.parameters.begin(), part.parameters.end(),
                       [&](const ParameterInfo& own) { return own.name == info.name; });
  });
  return all;
}

const IntegratorInfo kNoIntegrator;
const DenoiserInfo kNoDenoiser;

}  // namespace

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

std::string parameterText(const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const int64_t* integer = std::get_if<int64_t>(&value)) return std::to_string(*integer);
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.9g}", *number);
  return std::get<std::string>(value);
}

std::vector<ParameterInfo> parametersOf(const IntegratorInfo& integrator) {
  return ownFirst({&integrator, nullptr, &kNoDenoiser}, integrator);
}
std::vector<ParameterInfo> parametersOf(const CacheInfo& cache) {
  return ownFirst({&kNoIntegrator, &cache, &kNoDenoiser}, cache);
}
std::vector<ParameterInfo> parametersOf(const DenoiserInfo& denoiser) {
  return ownFirst({&kNoIntegrator, nullptr, &denoiser}, denoiser);
}

std::vector<std::string> parameterNames(const std::string& integrator,
                                        const std::string& denoiser) {
  std::vector<std::string> names;
  const auto add = [&](const auto& part) {
    for (const ParameterInfo& info : parametersOf(part))
      if (std::find(names.begin(), names.end(), info.name) == names.end())
        names.push_back(info.name);
  };
  for (const IntegratorInfo* info : integratorRegistry()) {
    if (info->name != integrator) continue;
    add(*info);
    for (const CacheInfo* cache : cacheRegistry())
      if (info->usesCache) add(*cache);
  }
  for (const DenoiserInfo* info : denoiserRegistry())
    if (info->name == denoiser) add(*info);
  return names;
}

}  // namespace restlab
