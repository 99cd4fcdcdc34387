// The settings that choose a method. Command line options, keys of suites and jobs, records and
// table columns are all made from this one list.
#pragma once

#include <string>
#include <vector>

#include "core/frame/method.h"
#include "core/frame/session.h"

namespace restlab {

struct MethodSetting {
  const char* key;  // key in suites and records, column name; on the command line `--key`
  const char* help;
  std::string SessionConfig::*value;
};

// Settings in the order of tables.
const std::vector<MethodSetting>& methodSettings();

// Name of the cache for tables and records: "none" if the integrator keeps no reservoirs.
std::string cacheName(const SessionConfig& config);
// Key and value of each setting.
std::vector<std::pair<std::string, std::string>> settingValues(const SessionConfig& config);

// Text of a parameter's value, for people and keys.
std::string parameterText(const ParameterValue& value);

// Parameters that a part brings into a method: its own first, then those of the parts that come
// with it, all with the defaults that the part gives them.
std::vector<ParameterInfo> parametersOf(const IntegratorInfo& integrator);
std::vector<ParameterInfo> parametersOf(const CacheInfo& cache);
std::vector<ParameterInfo> parametersOf(const DenoiserInfo& denoiser);
// Names of the parameters of a method of that integrator and denoiser, with any cache. An unknown
// part has none.
std::vector<std::string> parameterNames(const std::string& integrator, const std::string& denoiser);

}  // namespace restlab
