// A backend runs kernels over pixels: it owns the buffers, dispatches passes and times them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"
#include "core/dialect/types.h"

namespace restlab {

class CompiledScene;

using BufferId = uint32_t;
constexpr BufferId kNoBuffer = 0xffffffffu;

struct PassCounters {
  uint64_t raysPath = 0, raysShadow = 0;
  uint64_t health[rl::RL_HEALTH_COUNT] = {};
};

struct BackendInfo {
  std::string name;
  std::string description;  // device, library versions
  bool available = true;
  std::string whyNot;
};

class Backend {
 public:
  virtual ~Backend() = default;

  // Zeroed memory; throws Error (deviceUnavailable) with the sizes when there is not enough.
  virtual BufferId allocate(size_t bytes) = 0;
  virtual void clear(BufferId buffer) = 0;
  virtual void read(BufferId buffer, void* to, size_t bytes) const = 0;

  // The mask of the instantiation that serves `needed`; throws Error (badUsage) for unknown
  // kernels.
  virtual uint32_t maskFor(const std::string& kernel, uint32_t needed) const = 0;

  // Runs a kernel over width x height pixels. `buffers` in the order of the kernel's Buffers struct
  // (kNoBuffer binds null). Returns the time in milliseconds, counters added up.
  virtual double dispatch(const std::string& kernel, uint32_t mask, const rl::FrameData& frame,
                          const std::vector<BufferId>& buffers,
                          const std::vector<std::byte>& params, PassCounters& counters) = 0;
};

std::unique_ptr<Backend> makeCpuBackend(std::shared_ptr<const CompiledScene> scene, int threads);
BackendInfo cpuBackendInfo();

// All backends, for `restlab list backends`.
std::vector<BackendInfo> backendRegistry();
std::unique_ptr<Backend> makeBackend(const std::string& name,
                                     std::shared_ptr<const CompiledScene> scene, int threads);

}  // namespace restlab
