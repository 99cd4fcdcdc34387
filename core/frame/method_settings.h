// The settings that choose a method. Command line options, keys of suites and jobs, records and
// table columns are all made from this one list.
#pragma once

#include <string>
#include <vector>

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

}  // namespace restlab
