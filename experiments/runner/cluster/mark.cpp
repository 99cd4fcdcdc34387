#include "experiments/runner/cluster/mark.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/cluster/plan.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

double numberIn(const char* name) { return std::strtod(variable(name).c_str(), nullptr); }

// Returns the scheduler's name of this job: "17_3" of an array, "17" of a single one.
std::string schedulerJob() {
  const std::string array = variable("SLURM_ARRAY_JOB_ID");
  return array.empty() ? variable("SLURM_JOB_ID") : array + "_" + variable("SLURM_ARRAY_TASK_ID");
}

}  // namespace

TaskMark::TaskMark(const fs::path& folder, uint64_t index)
    : file_(markFile(folder, index)), started_(utcNow()) {
  write("");
}

void TaskMark::done() {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

void TaskMark::failed(const std::string& line) {
  try {
    write(line);
  } catch (const Error&) {
  }
}

void TaskMark::write(const std::string& error) const {
  const Json json = {{"node", nodeName()},
                     {"process", getpid()},
                     {"job", schedulerJob()},
                     {"started", started_},
                     {"asked_s", numberIn(kAskedTime)},
                     {"asked_mib", numberIn(kAskedMemory)},
                     {"error", error}};
  writeTextFile(file_, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::optional<Mark> readMark(const fs::path& folder, uint64_t index) {
  std::ifstream in(markFile(folder, index), std::ios::binary);
  if (!in) return std::nullopt;
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Mark mark;
  mark.node = json.value("node", "");
  mark.job = json.value("job", "");
  mark.started = json.value("started", "");
  mark.process = json.value("process", 0);
  mark.asked = {json.value("asked_s", 0.0), json.value("asked_mib", 0.0)};
  mark.error = json.value("error", "");
  return mark;
}

std::optional<bool> isAlive(const Mark& mark) {
  if (mark.node != nodeName() || mark.process <= 0) return std::nullopt;
  return kill(mark.process, 0) == 0 || errno != ESRCH;
}

}  // namespace restlab
