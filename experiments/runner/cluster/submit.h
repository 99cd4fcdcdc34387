// `submit`: hands the tasks of a plan to an engine until all are done, and collects.
#pragma once

#include "experiments/runner/cluster/collect.h"
#include "experiments/runner/cluster/engine.h"
#include "experiments/runner/cluster/submissions.h"

namespace restlab {

struct SubmitRequest {
  std::filesystem::path folder;
  std::string engine = "local", options;
  uint32_t processes = 1;  // of the local engine
  bool goesOn = false;     // called by a job of the scheduler, not by hand
};

// Merges references whose chunks are there, adds chunks where an error is not small enough, and
// hands over what is missing. A task that ended without a result (killed, out of memory or time, a
// lost node) is handed over once more, for twice the memory and time; one that ended with an error
// is not. With jobs: prints their ids, and the last of them goes on from here. Without: returns
// when nothing is left to do. Returns what was collected; nothing while jobs go on. Throws Error,
// also if jobs of this plan are in the queue and it is called by hand.
std::optional<Collected> submitPlan(const SubmitRequest& request, Plan plan);

}  // namespace restlab
