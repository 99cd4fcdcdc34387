// Every method of the registries, and for each of its parameters a value other than the default.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/frame/method.h"
#include "core/frame/session.h"

namespace restlab {

inline std::vector<SessionConfig> everyMethod() {
  std::vector<SessionConfig> all;
  for (const IntegratorInfo* integrator : integratorRegistry()) {
    std::vector<std::string> caches = {""};
    if (integrator->usesCache) {
      caches.clear();
      for (const CacheInfo* cache : cacheRegistry()) caches.push_back(cache->name);
    }
    for (const std::string& cache : caches) {
      for (const DenoiserInfo* denoiser : denoiserRegistry()) {
        SessionConfig config;
        config.integrator = integrator->name;
        config.cache = cache;
        config.denoiser = denoiser->name;
        all.push_back(config);
      }
    }
  }
  return all;
}

// Returns a value in range, other than the default where the range has one.
inline ParameterValue anotherValue(const ParameterInfo& info) {
  const auto farthest = [&](double fallback) {
    const bool isLow = fallback - info.minValue < info.maxValue - fallback;
    return isLow ? info.maxValue : info.minValue;
  };
  if (const bool* fallback = std::get_if<bool>(&info.defaultValue)) return !*fallback;
  if (const int64_t* fallback = std::get_if<int64_t>(&info.defaultValue))
    return int64_t(farthest(double(*fallback)));
  if (const double* fallback = std::get_if<double>(&info.defaultValue)) return farthest(*fallback);
  const auto other =
      std::find_if(info.choices.begin(), info.choices.end(), [&](const std::string& choice) {
        return choice != std::get<std::string>(info.defaultValue);
      });
  return other == info.choices.end() ? info.defaultValue : ParameterValue(*other);
}

}  // namespace restlab
