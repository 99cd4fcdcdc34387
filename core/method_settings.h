// The settings that choose a method. Options of the command line, keys of suites, keys of jobs,
// records and columns of tables are all made of this one list.
#pragma once

#include <string>
#include <vector>

#include "core/session.h"

namespace restlab {

struct MethodSetting {
  const char* key;  // in suites and records, and a column's name; on the command line `--key`
  const char* help;
  std::string SessionConfig::*value;
};

// In the order in which tables have them.
const std::vector<MethodSetting>& methodSettings();

// As tables and records say it: "none" where the integrator keeps no reservoirs.
std::string cacheName(const SessionConfig& config);
// Key and value of each.
std::vector<std::pair<std::string, std::string>> settingValues(const SessionConfig& config);

}  // namespace restlab
