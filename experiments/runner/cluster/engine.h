// Whoever runs `restlab work DIR --index I` for many I: Slurm, or processes on this machine.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/cluster/asked.h"
#include "experiments/runner/cluster/plan.h"

namespace restlab {

class Engine {
 public:
  virtual ~Engine() = default;
  // Cuts sorted numbers of tasks into those that one launch() takes.
  virtual std::vector<std::vector<uint64_t>> parts(const std::vector<uint64_t>& tasks) const = 0;
  // Hands tasks over. Returns the id of their job. An engine that has none (hasJobs()) returns when
  // the tasks have ended. Throws Error (badInput) if the scheduler refuses them.
  virtual std::string launch(const std::vector<uint64_t>& tasks, const Asked& asked) = 0;
  // Hands over the job that goes on with the plan after the jobs `after` have ended, however they
  // did. Returns its id. Throws as launch().
  virtual std::string goOn(const Asked& asked, const std::vector<std::string>& after) = 0;
  virtual bool hasJobs() const = 0;
};

// Jobs of a plan that Slurm knows, with their states: "17_3", "RUNNING". Nothing if there is no
// Slurm here.
struct QueuedJob {
  std::string id, state;
};
std::optional<std::vector<QueuedJob>> slurmQueue(const std::filesystem::path& folder,
                                                 const Plan& plan);

// Returns how Slurm says that jobs ("17_3", "18") of a plan ended: "OUT_OF_MEMORY". Leaves out
// those that it does not know any more. Asks once for all of them, and its accounting once for
// those that it has forgotten.
std::map<std::string, std::string> slurmEnds(const std::filesystem::path& folder, const Plan& plan,
                                             const std::vector<std::string>& jobs);

// Throws Error (badUsage) if there is no Slurm here. `options`: further words of #SBATCH.
std::unique_ptr<Engine> makeSlurm(const std::filesystem::path& folder, const Plan& plan,
                                  const std::string& options);

// `processes`: at a time.
std::unique_ptr<Engine> makeLocal(const std::filesystem::path& folder, uint32_t processes);

}  // namespace restlab
