// Sums over the passes of a frame.
#pragma once

#include "core/frame/pipeline.h"
#include "core/frame/session.h"

namespace restlab {

FrameStats statsOf(const std::vector<Pipeline::PassResult>& passes);

}  // namespace restlab
