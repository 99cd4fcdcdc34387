// Sums over the passes of a frame.
#pragma once

#include "core/pipeline.h"
#include "core/session.h"

namespace restlab {

FrameStats statsOf(const std::vector<Pipeline::PassResult>& passes);

}  // namespace restlab
