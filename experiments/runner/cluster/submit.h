// `submit`: hands the tasks of a plan to an engine until all are done, and collects.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "experiments/runner/cluster/collect.h"
#include "experiments/runner/cluster/submissions.h"

namespace restlab {

struct SubmitRequest {
  std::filesystem::path folder;
  std::string engine = "local", options;
  uint32_t processes = 1;  // of the local engine
  bool goesOn = false;     // called by a job of the scheduler, not by hand
  bool prints = true;      // lines about jobs, to stdout
};

struct Submitted {
  std::vector<Submission> jobs;        // of the scheduler; the last one goes on with the plan
  std::optional<Collected> collected;  // nothing while jobs go on
  std::optional<Error> refusal;        // by the scheduler: of a part of the tasks, or of that job
};

// Merges references whose chunks are there, adds chunks where an error is not small enough, and
// hands over what is missing; runs once their references are merged. A task that ended without a
// result (killed, out of memory or time, a lost node) is handed over once more, for twice the
// memory and time, one that never began or whose chunk is damaged once more as it was; one that
// ended with an error is not. With jobs: the last of them goes on from here. Without: returns when
// nothing is left to do. Throws Error if jobs of this plan are in the queue and it is called by
// hand.
Submitted submitPlan(const SubmitRequest& request, Plan plan);

}  // namespace restlab
