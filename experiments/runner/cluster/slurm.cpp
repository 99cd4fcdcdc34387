// Slurm, by its commands: sbatch, squeue, scontrol, sacct.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/cluster/command.h"
#include "experiments/runner/cluster/engine.h"
#include "experiments/runner/cluster/mark.h"
#include "experiments/runner/cluster/tasks_there.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kUsualArray = 1001;  // Slurm's MaxArraySize unless it is set
// Runs are handed over when their references are merged, but a network file system may show these a
// minute later on another node.
constexpr int kWaitS = 150;

// Name of all jobs of a plan in a folder: the same suite may have another one.
std::string jobName(const fs::path& folder, const Plan& plan) {
  std::error_code status;
  const fs::path place = fs::weakly_canonical(folder, status);
  const size_t hash = std::hash<std::string>()((status ? folder : place).string());
  return fmt::format("restlab-{}-{:08x}", plan.id.substr(0, 8), uint32_t(hash));
}

// Returns the head of a script. All of an array write to one file: one each would be thousands.
std::string headOf(const fs::path& folder) {
  return fmt::format(
      "#!/bin/bash\n#SBATCH --output=\"{}/slurm/%A.log\" --open-mode=append\n#SBATCH --requeue\n",
      folder.string());
}

// Returns the user's words, then the name by which the queue is searched, and what is asked for:
// where the user's words ask for it, this is theirs or twice as much.
std::string askingOf(const std::string& options, const std::string& name, const Asked& asked) {
  std::string text = options.empty() ? "" : fmt::format("#SBATCH {}\n", options);
  text += fmt::format("#SBATCH --job-name={}\n", name);
  if (asked.memoryMiB > 0.0)
    text += fmt::format("#SBATCH --mem={:.0f}M\n", std::ceil(asked.memoryMiB));
  if (asked.seconds > 0.0)
    text += fmt::format("#SBATCH --time={:.0f}\n", std::ceil(asked.seconds / 60.0));
  return text;
}

uint64_t maxArraySize() {
  std::istringstream config(runCommand({"scontrol", "show", "config"}).out);
  for (std::string line; std::getline(config, line);) {
    const size_t at = line.find('=');
    if (line.rfind("MaxArraySize", 0) == 0 && at != std::string::npos)
      return std::max<uint64_t>(1, std::strtoull(line.c_str() + at + 1, nullptr, 10));
  }
  return kUsualArray;
}

std::optional<std::vector<QueuedJob>> jobsOf(const fs::path& folder, const Plan& plan,
                                             const std::vector<std::string>& more) {
  std::vector<std::string> words = {"squeue", "-h",   "-r", "-n", jobName(folder, plan),
                                    "-o",     "%i %T"};
  words.insert(words.end(), more.begin(), more.end());
  const CommandResult result = runCommand(words);
  if (result.code != 0) return std::nullopt;
  std::vector<QueuedJob> jobs;
  std::istringstream lines(result.out);
  for (QueuedJob job; lines >> job.id >> job.state;) jobs.push_back(job);
  return jobs;
}

class Slurm : public Engine {
 public:
  Slurm(const fs::path& folder, const Plan& plan, const std::string& options)
      : folder_(folder), plan_(plan), options_(options), arraySize_(maxArraySize()) {
    makeWritableDirectory(folder_ / "slurm");
  }

  // An array's numbers end at MaxArraySize, whatever it has of them.
  std::vector<std::vector<uint64_t>> parts(const std::vector<uint64_t>& tasks) const override {
    std::vector<std::vector<uint64_t>> parts;
    for (const uint64_t task : tasks) {
      if (parts.empty() || parts.back().back() / arraySize_ != task / arraySize_)
        parts.push_back({});
      parts.back().push_back(task);
    }
    return parts;
  }

  std::string launch(const std::vector<uint64_t>& tasks, const Asked& asked) override {
    const uint64_t offset = tasks.front() / arraySize_ * arraySize_;
    std::vector<uint64_t> numbers;
    for (const uint64_t task : tasks) numbers.push_back(task - offset);
    std::string text = headOf(folder_);
    text += fmt::format("#SBATCH --array={}\n", rangesText(numbers));
    // A worker that uses all cores of a node is to have the node for itself.
    text += plan_.threads > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", plan_.threads)
                              : std::string("#SBATCH --exclusive\n");
    text += askingOf(options_, jobName(folder_, plan_), asked);
    if (asked.memoryMiB > 0.0)
      text += fmt::format("export {}={:.0f}\n", kAskedMemory, asked.memoryMiB);
    if (asked.seconds > 0.0) text += fmt::format("export {}={:.0f}\n", kAskedTime, asked.seconds);
    return submit(text + fmt::format("exec {} --index $((SLURM_ARRAY_TASK_ID + {})) -q\n",
                                     shellCommand({ownProgram(), "work", folder_.string(), "--wait",
                                                   std::to_string(kWaitS)}),
                                     offset));
  }

  std::string goOn(const Asked& asked, const std::vector<std::string>& after) override {
    return submit(headOf(folder_) + askingOf(options_, jobName(folder_, plan_), asked) +
                  fmt::format("#SBATCH --dependency=afterany:{}\n", fmt::join(after, ":")) +
                  fmt::format("# What has ended without a result is asked for again, once; then "
                              "results are collected.\nexec {}\n",
                              shellCommand({ownProgram(), "submit", folder_.string(), "--engine",
                                            "slurm", "--go-on"})));
  }

  bool hasJobs() const override { return true; }

 private:
  std::string submit(const std::string& text) {
    size_t number = 0;
    fs::path file;
    std::error_code status;
    do {
      file = folder_ / "slurm" / fmt::format("{:03}.sh", ++number);
    } while (fs::exists(file, status));
    writeTextFile(file, text);
    const CommandResult result = runCommand({"sbatch", "--parsable", file.string()});
    const std::string id = result.out.substr(0, result.out.find_first_of(";\n"));
    if (result.code != 0 || id.empty()) {
      failInput(fmt::format("{}: sbatch refuses it: {}", file.string(), firstLineOf(result.err)));
    }
    return id;
  }

  fs::path folder_;
  const Plan& plan_;
  std::string options_;
  uint64_t arraySize_;
};

}  // namespace

std::optional<std::vector<QueuedJob>> slurmQueue(const fs::path& folder, const Plan& plan) {
  return jobsOf(folder, plan, {});
}

std::map<std::string, std::string> slurmEnds(const fs::path& folder, const Plan& plan,
                                             const std::vector<std::string>& jobs) {
  std::map<std::string, std::string> ends;
  if (jobs.empty()) return ends;
  const std::set<std::string> wanted(jobs.begin(), jobs.end());
  const auto known = jobsOf(folder, plan, {"-t", "all"}).value_or(std::vector<QueuedJob>());
  for (const QueuedJob& job : known)
    if (wanted.count(job.id) != 0) ends[job.id] = job.state;
  std::set<std::string> forgotten;  // by the number of their array
  for (const std::string& job : jobs)
    if (ends.count(job) == 0) forgotten.insert(job.substr(0, job.find('_')));
  if (forgotten.empty()) return ends;
  const CommandResult accounted = runCommand({"sacct", "-n", "-X", "-P", "-o", "JobID,State", "-j",
                                              fmt::format("{}", fmt::join(forgotten, ","))});
  std::istringstream lines(accounted.code == 0 ? accounted.out : "");
  for (std::string line; std::getline(lines, line);) {
    const size_t bar = line.find('|');
    if (bar == std::string::npos) continue;
    // "CANCELLED by 1000"
    ends.emplace(line.substr(0, bar), line.substr(bar + 1, line.find(' ', bar) - bar - 1));
  }
  return ends;
}

std::unique_ptr<Engine> makeSlurm(const fs::path& folder, const Plan& plan,
                                  const std::string& options) {
  const CommandResult there = runCommand({"sbatch", "--version"});
  if (there.code == 127) {
    failUsage(
        "--engine slurm: there is no sbatch here; submit from a machine of the cluster, or use "
        "--engine local");
  }
  const CommandResult answers = runCommand({"scontrol", "ping"});
  if (there.code != 0 || answers.code != 0) {
    failInput(fmt::format("--engine slurm: the scheduler does not answer: {}",
                          firstLineOf(answers.err.empty() ? answers.out : answers.err)));
  }
  return std::make_unique<Slurm>(folder, plan, options);
}

}  // namespace restlab
