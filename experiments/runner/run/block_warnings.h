// Warnings about a scene that a reader must see before its rows.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Returns one line per warning, with the block's label: a black reference, one that may lack
// lights, a camera that walks through walls, filters at the end of float32.
std::vector<std::string> warningsOf(const Suite& suite, const PreparedScene& prepared,
                                    const BlockResult& block);

}  // namespace restlab
