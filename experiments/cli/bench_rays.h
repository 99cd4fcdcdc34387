// Rays per second of a backend alone, and bytes per second of its memory: upper bounds for passes.
#pragma once

#include "core/backend/backend.h"
#include "experiments/cli/bench_embree.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab {

struct BackendRates {
  double primary = 0.0, shadow = 0.0, incoherent = 0.0;  // rays per second, the median repetition
  double bytesPerSecond = 0.0;                           // read plus written, by a plain copy
};

// Repeats each kind for at least `seconds`; timed like passes.
BackendRates measureBackend(const PreparedScene& prepared, const std::string& backend,
                            const BackendOptions& options, const RaySets& rays, double seconds);

}  // namespace restlab
