#include "experiments/runner/base/build_info.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "core/base/libraries.h"
#include "source_hash.h"

namespace restlab {

namespace {

// Returns the first line of a small system file, or "unknown".
std::string firstLine(const char* file) {
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && !line.empty() ? line : "unknown";
}

std::vector<std::string> argvOfProgram;

}  // namespace

std::string shellCommand(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool isPlain = !word.empty() && word.find_first_not_of(
                                              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_-+=./:,@%") == std::string::npos;
    line += line.empty() ? "" : " ";
    if (isPlain) {
      line += word;
      continue;
    }
    line += "'";
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += "'";
  }
  return line;
}

void setArguments(std::vector<std::string> argv) { argvOfProgram = std::move(argv); }
const std::vector<std::string>& arguments() { return argvOfProgram; }

const BuildInfo& buildInfo() {
  static const BuildInfo info = {
      RESTLAB_SOURCE_HASH, RESTLAB_REFERENCE_HASH, RESTLAB_BDPT_HASH, RESTLAB_MEASURING_HASH,
      RESTLAB_GIT_COMMIT,  RESTLAB_GIT_DIRTY != 0, RESTLAB_COMPILER,  RESTLAB_COMPILER_FLAGS,
      RESTLAB_BUILD_TYPE,  RESTLAB_VERSION};
  return info;
}

std::string librariesText() {
  std::string text;
  for (const auto& [name, version] : libraryVersions())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, version);
  return text;
}

std::string cpuModel() {
  std::ifstream in("/proc/cpuinfo");
  std::string line;
  while (std::getline(in, line)) {
    const size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string nodeName() {
  char name[65] = {};
  return gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc = {};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

double peakResidentMiB() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

double processCpuSeconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

nlohmann::ordered_json buildJson() {
  const BuildInfo& build = buildInfo();
  return {{"version", build.version},
          {"git_commit", build.gitCommit},
          {"git_dirty", build.gitDirty},
          {"source_hash", build.sourceHash},
          {"reference_hash", build.referenceHash},
          {"compiler", build.compiler},
          {"flags", build.compilerFlags},
          {"build_type", build.buildType},
          {"measuring_hash", build.measuringHash},
          {"libraries", librariesText()}};
}

nlohmann::ordered_json machineJson() {
  utsname system = {};
  uname(&system);
  double load[3] = {-1.0, -1.0, -1.0};
  if (getloadavg(load, 3) < 1) load[0] = -1.0;
  const double memoryMiB =
      double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
  return {{"node", nodeName()},
          {"cpu", cpuModel()},
          {"cores", std::thread::hardware_concurrency()},
          {"governor", firstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")},
          {"load_1min", load[0]},
          {"memory_mib", memoryMiB},
          {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)}};
}

nlohmann::ordered_json provenanceJson() {
  return {{"utc", utcNow()},
          {"command", shellCommand(argvOfProgram)},
          {"build", buildJson()},
          {"machine", machineJson()},
          {"peak_resident_mib", peakResidentMiB()}};
}

std::map<std::string, std::string> provenanceWords() {
  const BuildInfo& build = buildInfo();
  const nlohmann::ordered_json machine = machineJson();
  return {
      {"utc", utcNow()},
      {"command", shellCommand(argvOfProgram)},
      {"version", build.version},
      {"git_commit", build.gitCommit + (build.gitDirty ? " modified" : "")},
      {"compiler", fmt::format("{} {} {}", build.compiler, build.buildType, build.compilerFlags)},
      {"libraries", librariesText()},
      {"cpu", cpuModel()},
      {"cores", machine["cores"].dump()},
      {"load_1min", machine["load_1min"].dump()},
      {"governor", machine["governor"].get<std::string>()},
      {"system", machine["system"].get<std::string>()},
      {"peak_resident_mib", fmt::format("{:.1f}", peakResidentMiB())}};
}

}  // namespace restlab
