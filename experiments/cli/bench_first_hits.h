// Time of first hits by rays and by the rasteriser.
#pragma once

#include "core/frame/session.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab {

// Prints a table of image sizes. seconds: for each size and each of both ways.
void benchFirstHits(const PreparedScene& prepared, const SessionConfig& config, double seconds,
                    bool asJson);

}  // namespace restlab
