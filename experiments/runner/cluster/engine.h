// Whoever runs `restlab work DIR --index I` for many I: Slurm, or processes on this machine.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/cluster/plan.h"
#include "experiments/runner/cluster/asked.h"

namespace restlab {

class Engine {
 public:
  virtual ~Engine() = default;
  // Hands tasks over; they begin after the jobs `after` have ended, however they did. Returns ids
  // of the jobs. An engine that has none (hasJobs()) returns when the tasks have ended.
  virtual std::vector<std::string> launch(const std::vector<uint64_t>& tasks, const Asked& asked,
                                          const std::vector<std::string>& after) = 0;
  // Hands over the job that goes on with the plan after the jobs `after`. Returns its id.
  virtual std::string goOn(const Asked& asked, const std::vector<std::string>& after) = 0;
  virtual bool hasJobs() const = 0;
  // Returns how the scheduler says that a job ("17_3") ended: "OUT_OF_MEMORY"; "" if unknown.
  virtual std::string endOf(const std::string& job) const = 0;
};

// Jobs of a plan that Slurm knows, with their states: "17_3", "RUNNING". Nothing if there is no
// Slurm here.
struct QueuedJob {
  std::string id, state;
};
std::optional<std::vector<QueuedJob>> slurmQueue(const std::filesystem::path& folder,
                                                 const Plan& plan);

// Throws Error (badUsage) if there is no Slurm here. `options`: further words of #SBATCH, which
// win over those that come from the plan.
std::unique_ptr<Engine> makeSlurm(const std::filesystem::path& folder, const Plan& plan,
                                  const std::string& options);

// Returns the script of an array: `tasks` are its numbers plus `offset`.
std::string slurmScript(const std::filesystem::path& folder, const Plan& plan,
                        const std::string& options, const std::vector<uint64_t>& tasks,
                        uint64_t offset, const Asked& asked, const std::vector<std::string>& after);

// `processes`: at a time.
std::unique_ptr<Engine> makeLocal(const std::filesystem::path& folder, uint32_t processes);

}  // namespace restlab
