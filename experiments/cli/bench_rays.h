// Rays per second of a backend alone, and its memory's bytes per second: the roofs that a pass is
// held against.
#pragma once

#include "core/backend/backend.h"
#include "experiments/cli/bench_embree.h"
#include "experiments/runner/run/prepare.h"

namespace restlab {

struct BackendRates {
  double primary = 0.0, shadow = 0.0, incoherent = 0.0;  // rays per second, the median repetition
  double bytesPerSecond = 0.0;                           // read and written, of a plain copy
};

// Each kind is repeated for at least `seconds`; timed as passes are.
BackendRates measureBackend(const PreparedScene& prepared, const std::string& backend,
                            const BackendOptions& options, const RaySets& rays, double seconds);

}  // namespace restlab
