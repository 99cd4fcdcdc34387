// References of a plan in its folder: their chunks, and what is merged of them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "experiments/runner/cluster/plan.h"
#include "experiments/runner/run/block.h"

namespace restlab {

// Scene and reference of a planned reference.
NeededReference neededOf(const std::vector<Suite>& points, const PlannedReference& planned);

// Returns indices of the chunks of a reference that have no file.
std::vector<uint64_t> missingChunks(const std::filesystem::path& folder, const Plan& plan,
                                    size_t reference);

// Returns "reference NAME is not there; tasks that are not done: 1, 2".
std::string notThereText(const Plan& plan, size_t reference, const std::vector<uint64_t>& missing);

// Merges the chunks of a reference, all of which have a file, and stores the result in the folder.
// Returns nothing if some are damaged: they get the name FILE.damaged, a line names each, and their
// tasks are missing from then on. Throws Error (badInput) if the folder cannot be written.
std::optional<Reference> mergedReference(const std::filesystem::path& folder, const Plan& plan,
                                         size_t reference, const NeededReference& needed);

}  // namespace restlab
