#include "experiments/runner/cluster/asked.h"

#include <algorithm>

namespace restlab {

namespace {

// Margins. Compiling a kernel takes up to a minute and 1 GiB where no cache has it.
constexpr double kTimes = 3.0, kMoreS = 300.0, kMemoryTimes = 1.25, kMoreMiB = 1024.0;

}  // namespace

Asked estimateOf(const Plan& plan, const Task& task) {
  Asked asked;
  if (task.isReference) {
    const PlannedReference& reference = plan.references[task.of];
    const uint64_t spp = reference.isWhole ? plan.target.spp : task.end - task.first;
    asked.seconds = reference.sampleS * double(spp);
    if (reference.isWhole && plan.target.timeLimitS > 0.0) asked.seconds = plan.target.timeLimitS;
    asked.memoryMiB = double(reference.pixels) * double(referenceBytesPerPixel(plan.target)) / kMiB;
    if (reference.sampleS == 0.0) asked.memoryMiB = 0.0;
  } else {
    asked.seconds = plan.tables[task.of].runS * double(task.end - task.first);
    asked.memoryMiB = plan.tables[task.of].memoryMiB;
  }
  if (asked.memoryMiB > 0.0) asked.memoryMiB += plan.residentMiB;
  return asked;
}

Asked askedFor(const Plan& plan, const std::vector<Task>& tasks, double times) {
  Asked most;
  for (const Task& task : tasks) {
    const Asked one = estimateOf(plan, task);
    most.seconds = std::max(most.seconds, one.seconds);
    most.memoryMiB = std::max(most.memoryMiB, one.memoryMiB);
  }
  if (most.seconds > 0.0) most.seconds = times * (kTimes * most.seconds + kMoreS);
  if (most.memoryMiB > 0.0) most.memoryMiB = times * (kMemoryTimes * most.memoryMiB + kMoreMiB);
  return most;
}

}  // namespace restlab
