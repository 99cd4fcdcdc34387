// Slurm, by its commands: sbatch, squeue, scontrol, sacct.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

// Name of all jobs of a plan in a folder: the same suite may have another one.
std::string jobName(const fs::path& folder, const Plan& plan) {
  std::error_code status;
  const fs::path place = fs::weakly_canonical(folder, status);
  const size_t hash = std::hash<std::string>()((status ? folder : place).string());
  return fmt::format("restlab-{}-{:08x}", plan.id.substr(0, 8), uint32_t(hash));
}

std::string dependency(const std::vector<std::string>& after) {
  return after.empty() ? ""
                       : fmt::format("#SBATCH --dependency=afterany:{}\n", fmt::join(after, ":"));
}

// Returns the head of a script. All of an array write to one file: one each would be thousands.
std::string headOf(const fs::path& folder, const Plan& plan, const Asked& asked,
                   const std::vector<std::string>& after) {
  std::string text = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --output=\"{}/slurm/%A.log\" "
      "--open-mode=append\n"
      "#SBATCH --requeue\n",
      jobName(folder, plan), folder.string());
  text += dependency(after);
  if (asked.memoryMiB > 0.0)
    text += fmt::format("#SBATCH --mem={:.0f}M\n", std::ceil(asked.memoryMiB));
  if (asked.seconds > 0.0)
    text += fmt::format("#SBATCH --time={:.0f}\n", std::ceil(asked.seconds / 60.0));
  return text;
}

std::string optionsLine(const std::string& options) {
  return options.empty() ? "" : fmt::format("#SBATCH {}\n", options);
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

class Slurm : public Engine {
 public:
  Slurm(const fs::path& folder, const Plan& plan, const std::string& options)
      : folder_(folder), plan_(plan), options_(options), arraySize_(maxArraySize()) {
    makeWritableDirectory(folder_ / "slurm");
  }

  std::vector<std::string> launch(const std::vector<uint64_t>& tasks, const Asked& asked,
                                  const std::vector<std::string>& after) override {
    std::vector<std::string> ids;
    for (size_t first = 0; first < tasks.size();) {
      // An array's numbers end at MaxArraySize, whatever it has of them.
      const uint64_t part = tasks[first] / arraySize_;
      size_t end = first;
      while (end < tasks.size() && tasks[end] / arraySize_ == part) ++end;
      const std::vector<uint64_t> own(tasks.begin() + ptrdiff_t(first),
                                      tasks.begin() + ptrdiff_t(end));
      ids.push_back(
          submit(slurmScript(folder_, plan_, options_, own, part * arraySize_, asked, after)));
      first = end;
    }
    return ids;
  }

  std::string goOn(const Asked& asked, const std::vector<std::string>& after) override {
    return submit(headOf(folder_, plan_, asked, after) + optionsLine(options_) +
                  fmt::format("# What has ended without a result is asked for again, once; then "
                              "results are collected.\nexec {}\n",
                              shellCommand({ownProgram(), "submit", folder_.string(), "--engine",
                                            "slurm", "--go-on"})));
  }

  bool hasJobs() const override { return true; }

  std::string endOf(const std::string& job) const override {
    const std::string known = runCommand({"scontrol", "-o", "show", "job", job}).out;
    const std::string word = "JobState=";
    if (const size_t at = known.find(word); at != std::string::npos)
      return known.substr(at + word.size(), known.find(' ', at) - at - word.size());
    const CommandResult accounted =
        runCommand({"sacct", "-n", "-X", "-P", "-o", "State", "-j", job});
    return accounted.code == 0 ? accounted.out.substr(0, accounted.out.find_first_of(" \n")) : "";
  }

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
  const CommandResult result =
      runCommand({"squeue", "-h", "-r", "--me", "-n", jobName(folder, plan), "-o", "%i %T"});
  if (result.code != 0) return std::nullopt;
  std::vector<QueuedJob> jobs;
  std::istringstream lines(result.out);
  for (QueuedJob job; lines >> job.id >> job.state;) jobs.push_back(job);
  return jobs;
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

std::string slurmScript(const fs::path& folder, const Plan& plan, const std::string& options,
                        const std::vector<uint64_t>& tasks, uint64_t offset, const Asked& asked,
                        const std::vector<std::string>& after) {
  std::vector<uint64_t> numbers;
  for (const uint64_t task : tasks) numbers.push_back(task - offset);
  std::string text = headOf(folder, plan, asked, after);
  text += fmt::format("#SBATCH --array={}\n", rangesText(numbers));
  // A worker that uses all cores of a node is to have the node for itself.
  text += plan.threads > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", plan.threads)
                           : std::string("#SBATCH --exclusive\n");
  text += optionsLine(options);
  if (asked.memoryMiB > 0.0)
    text += fmt::format("export {}={:.0f}\n", kAskedMemory, asked.memoryMiB);
  if (asked.seconds > 0.0) text += fmt::format("export {}={:.0f}\n", kAskedTime, asked.seconds);
  return text + fmt::format("exec {} --index $((SLURM_ARRAY_TASK_ID + {})) -q\n",
                            shellCommand({ownProgram(), "work", folder.string()}), offset);
}

}  // namespace restlab
