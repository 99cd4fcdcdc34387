// The pixels that a block's figures are taken over.
#pragma once

#include "experiments/runner/run/experiment.h"

namespace restlab {

// The camera of the measured frame where it is not the scene's.
std::optional<SceneCamera> measuredCamera(const Suite& suite, const BlockResult& block);

// Finds the pixels that show no light, and those of the suite's masks, where that was not done yet.
// Throws Error that starts with the mask's place: unknown objects, rectangles outside the image,
// no pixel left.
void prepareMasks(const Suite& suite, const PreparedScene& prepared, BlockResult& block);

}  // namespace restlab
