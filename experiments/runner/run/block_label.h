// Names of blocks in files.
#pragma once

#include <string>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Returns "cornell-box-all", followed by the point of a sweep; for file names.
std::string blockLabel(const Suite& suite, const BlockResult& block);
// Adds camera and size: the name of the block's reference in a folder of results.
std::string referenceLabel(const Suite& suite, const BlockResult& block);

}  // namespace restlab
