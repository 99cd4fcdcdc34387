// Masks of pixels that a block's figures are computed over.
#pragma once

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Returns the camera of the measured frame if it differs from the scene's.
std::optional<SceneCamera> measuredCamera(const Suite& suite, const BlockResult& block);

// Computes the light mask and the masks of the suite, unless that was done before. Throws Error
// that starts with the mask's place: unknown objects, rectangles outside the image, no pixel left.
void prepareMasks(const Suite& suite, const PreparedScene& prepared, BlockResult& block);

}  // namespace restlab
