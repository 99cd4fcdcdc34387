// Time and memory that a task asks for.
#pragma once

#include "experiments/runner/cluster/plan.h"

namespace restlab {

constexpr double kMiB = 1024.0 * 1024.0;

// Zeros: not measured.
struct Asked {
  double seconds = 0.0, memoryMiB = 0.0;
};

// Returns what the task will take, as the plan's measurement tells.
Asked estimateOf(const Plan& plan, const Task& task);

// Returns what to ask a scheduler for: the largest estimate of the tasks, with a margin for slower
// nodes, loading and compiling. `times`: 2 for tasks that were ended for too little of it.
Asked askedFor(const Plan& plan, const std::vector<Task>& tasks, double times);

// Returns samples per pixel of a chunk, a multiple of kBlockSpp. `wanted` 0: of `spp` at most
// kMostChunks chunks.
uint64_t sppOfChunk(uint64_t spp, uint64_t wanted);

}  // namespace restlab
