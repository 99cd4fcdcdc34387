// Entry of a kernel on the CPU: built in for the masks of core/features.list, or a unit.
#pragma once

#include <cstdint>

#include "core/dialect/features.h"
#include "core/dialect/types.h"

namespace rl {

// A run of pixels [x0, x1) x [y0, y1) of one pass.
struct CpuKernelTile {
  uint32_t x0, y0, x1, y1;
};

// Counters of one tile; summed in tile order.
struct CpuKernelCounters {
  uint64_t raysPath = 0;
  uint64_t raysShadow = 0;
  uint64_t health[RL_HEALTH_COUNT] = {};
};

struct CpuKernelArgs {
  const SceneData* scene = nullptr;
  const FrameData* frame = nullptr;
  const void* buffers = nullptr;  // the kernel's Buffers struct
  const void* params = nullptr;   // the kernel's Params struct
  void* embreeScene = nullptr;    // RTCScene
};

using CpuKernelEntry = void (*)(const CpuKernelArgs&, const CpuKernelTile&, CpuKernelCounters&);

// One row of the generated registry.
struct CpuKernelInfo {
  const char* name;
  const char* maskName;
  const char* trace;  // ray tracing: "embree" or "bvh"
  FeatureMask mask;
  CpuKernelEntry entry;
};

struct CpuKernelTable {
  const CpuKernelInfo* rows;
  uint32_t count;
};
// All kernels of the program.
CpuKernelTable cpuKernelTable();
// Called by the generated table alone; always true.
bool registerCpuKernels(CpuKernelTable table);

// The built-in kernel with the smallest mask that covers `needed`; null when there is none.
// The project's own hierarchy is compiled into the general mask only.
const CpuKernelInfo* findCpuKernel(const char* name, FeatureMask needed,
                                   const char* trace = "embree");

}  // namespace rl
