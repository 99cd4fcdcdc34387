// What this program was built from, and the machine it runs on.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace restlab {

struct BuildInfo {
  std::string sourceHash;     // of core/, integrators/, denoise/
  std::string referenceHash;  // of core/, integrators/path/
  std::string gitCommit;      // "unknown" outside a repository
  bool gitDirty = false;
  std::string compiler, compilerFlags, buildType;
  std::string version;
};
const BuildInfo& buildInfo();

// CPU, cores, governor, load, memory, operating system, library versions; for run.json.
nlohmann::ordered_json machineJson();
nlohmann::ordered_json buildJson();

std::string cpuModel();       // "unknown" where /proc/cpuinfo does not say
std::string embreeVersion();  // "3.13.5"
std::string utcNow();         // "2024-05-01T12:00:00Z"
double peakResidentMiB();     // of this process
double processCpuSeconds();   // user + system, of this process

}  // namespace restlab
