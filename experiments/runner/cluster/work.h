// `work`: does a task of a plan.
#pragma once

#include <filesystem>

#include "experiments/runner/cluster/plan.h"
#include "experiments/runner/run/block.h"

namespace restlab {

// Does one task and leaves its result in the folder, by a rename of a file that is whole. Returns
// false if a sound result is there already: then nothing is done. Several workers may do the same
// task; one result remains. Throws Error: badUsage for an index beyond the plan, badInput for
// another version of the program, references that are not complete (which chunks are missing), a
// full disk or a folder that has gone; interrupted after a signal.
bool workTask(const std::filesystem::path& folder, const Plan& plan, uint64_t index);

// Returns the reference of the plan from the folder. Merges its chunks if all of them are there.
// Throws Error (badInput) that names the missing ones.
Reference plannedReference(const std::filesystem::path& folder, const Plan& plan,
                           const PlannedReference& planned, const NeededReference& needed);

// Returns indices of the chunks of a reference that have no file.
std::vector<uint64_t> missingChunks(const std::filesystem::path& folder, const Plan& plan,
                                    size_t reference);

// Scene and reference of a planned reference.
NeededReference neededOf(const std::vector<Suite>& points, const PlannedReference& planned);

}  // namespace restlab
