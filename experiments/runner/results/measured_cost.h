// Time and memory of a block, measured by rendering a few frames of each method.
#pragma once

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Frames that are rendered of each method. The last one is timed: the first frame of a history is
// cheap, without reuse.
constexpr uint32_t kProbeFrames = 4;

struct MeasuredCost {
  double runS = 0.0;         // of one run of all methods, wall clock
  size_t bytesPerPixel = 0;  // of buffers of all methods together
};

// Renders kProbeFrames frames of each method. Throws Error (interrupted) after a signal.
MeasuredCost measureRun(const Suite& suite, const PreparedScene& prepared,
                        const BlockResult& block);

// Returns the seconds of a sample per pixel of the block's reference.
double secondsOfSample(const Suite& suite, const PreparedScene& prepared, const BlockResult& block);

}  // namespace restlab
