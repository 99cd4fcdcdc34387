// The frame of a method with reservoirs: which passes of reuse run, over which buffers.
#pragma once

#include <string>

#include "core/frame/frame_graph.h"
#include "core/reuse/reuse.h"

namespace restlab {

// The sample that a method resamples, as its buffers and kernels have it.
struct ReusedSample {
  std::string method;            // its kernels are <method>_initial, <method>_temporal and so on
  uint32_t reservoirUvec4s = 0;  // of a reservoir
};

// Name of the buffer of samples shifted to the k-th neighbours.
std::string pairedShiftsName(uint32_t neighbour);

// Name of the buffer of reservoirs that the last round over space read. `rounds`: its number.
std::string lastRoundsReservoirs(uint32_t rounds);

// Records the passes. `params`: the method's Params struct, which begins with `reuse`; `entries`:
// of the cache.
void recordReuse(FrameGraph& graph, const FrameInfo& frame, const ReusedSample& sample,
                 const rl::ReuseParams& reuse, const rl::EntryParams& entries,
                 std::vector<std::byte> params);

}  // namespace restlab
