// `work`: does a task of a plan.
#pragma once

#include <filesystem>

#include "experiments/runner/cluster/plan.h"

namespace restlab {

// Does one task and leaves its result in the folder, whole or not at all. Returns false if a sound
// result is there already: then nothing is done. Several workers may do the same task; the first
// result remains. `waitS`: seconds to wait for a merged reference that others see already. Throws
// Error: badUsage for an index beyond the plan, badInput for another version of the program,
// references that are not complete (which chunks are missing) or have changed, a full disk or a
// folder that has gone; interrupted after a signal.
bool workTask(const std::filesystem::path& folder, const Plan& plan, uint64_t index,
              double waitS = 0.0);

}  // namespace restlab
