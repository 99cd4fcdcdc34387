// Parameters of a frame as the kernels of restir_gi had them.
#pragma once

#include <cstring>

#include "core/frame/part.h"
#include "integrators/restir_gi/restir_gi.h"

namespace restlab {

// Returns zeros if no session has rendered the frame.
inline rl::PathReuseParams giParamsOf(const FrameSnapshot& snapshot) {
  rl::PathReuseParams params{};
  if (snapshot.params.size() == sizeof params)
    std::memcpy(&params, snapshot.params.data(), sizeof params);
  return params;
}

}  // namespace restlab
