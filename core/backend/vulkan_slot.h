// Memory and commands of one submission: inputs, counters, recorded command buffers.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>

#include "core/backend/backend.h"
#include "core/backend/vulkan_kernels.h"
#include "core/backend/vulkan_memory.h"
#include "core/backend/vulkan_parts.h"
#include "core/backend/vulkan_recording.h"

namespace restlab {

// Memory that the host writes before a frame and reads after it.
struct Slot {
  GpuBuffer inputs;    // frame data, then for each pass the addresses of its buffers and parameters
  GpuBuffer counters;  // GlslCounters for each band
  VulkanParts parts;   // submission of the running commands
  VulkanKernels::Bound bound;  // set if kernels read by texels
  std::map<RecordingKey, Recording> recordings;
  const Recording* running = nullptr;
  bool isStale = false;  // the recordings have bands that are too long
  RecordingKey runningKey;
  FrameResult before;  // of the earlier parts of the frame
  std::chrono::steady_clock::time_point started;
};

constexpr size_t kInputBytes = 128 * 1024;
constexpr size_t kCounterBytes = 64 * 1024;
constexpr size_t kPassOffset = 256;
constexpr size_t kPassBytes = 2048;  // addresses, then parameters
constexpr size_t kPassParams = 1024;
// Longer frames are submitted in parts.
constexpr size_t kMostPasses = (kInputBytes - kPassOffset) / kPassBytes;

}  // namespace restlab
