// Sources and compiler of this program, and the machine that it runs on.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace restlab {

struct BuildInfo {
  std::string sourceHash;     // of core/, integrators/, denoise/
  std::string referenceHash;  // of core/, integrators/path/
  std::string bdptHash;       // of core/, integrators/bdpt/
  std::string measuringHash;  // of the sources in experiments/ that compute a run's numbers
  std::string gitCommit;      // "unknown" outside a repository
  bool gitDirty = false;
  std::string compiler, compilerFlags, buildType;
  std::string version;
};
const BuildInfo& buildInfo();

// For run.json: CPU, cores, governor, load, memory, operating system, library versions.
nlohmann::ordered_json machineJson();
nlohmann::ordered_json buildJson();

// Command line of this program, for records; set once, by main().
void setArguments(std::vector<std::string> argv);
const std::vector<std::string>& arguments();
// Joins words to a shell command, quoted if necessary.
std::string shellCommand(const std::vector<std::string>& words);

// Returns build, machine, arguments, time and peak memory as metadata of an image.
std::map<std::string, std::string> provenanceWords();
// Returns the same for a line of results.jsonl.
nlohmann::ordered_json provenanceJson();

std::string librariesText();  // "Embree 3.13.5, TBB 2021.8.0, ..."
std::string cpuModel();       // "unknown" if /proc/cpuinfo has no name
std::string nodeName();       // of this machine
std::string utcNow();         // "2024-05-01T12:00:00Z"
double peakResidentMiB();     // of this process
double processCpuSeconds();   // user + system, of this process

}  // namespace restlab
