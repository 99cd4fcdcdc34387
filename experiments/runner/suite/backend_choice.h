// Which backend a session runs on, and what it says when its kernels are ready.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/backend/backend.h"
#include "core/session.h"

namespace restlab {

// All that there are; no backend has every one.
const std::vector<std::string>& rayTracingNames();
// True where a backend may have it: whether its device does, the session finds out.
bool mayTraceBy(const std::string& backend, const std::string& rayTracing);

// What methods of a table ran on.
struct DeviceUse {
  std::string backend, device, rayTracing;
  auto operator<=>(const DeviceUse&) const = default;
};
DeviceUse deviceUseOf(const Session& session);

// Start-up of several sessions in as few lines as it needs. Kernels that were ready before are in
// no report, so that nothing is said twice.
class StartupLog {
 public:
  // `firstKernel`, `firstNotice`: those before them were added already.
  void add(const Session& session, size_t firstKernel = 0, size_t firstNotice = 0);
  // Warnings, then "vulkan: 3 kernels ready in 2.4 s (2 from the cache) on ..." for each device;
  // with -v one line a kernel.
  void print();

 private:
  struct Entry {
    DeviceUse use;
    std::vector<KernelReport> kernels;
  };
  std::vector<Entry> entries_;
  std::vector<std::string> notices_;
};

// For a single session.
void logStartup(const Session& session);

}  // namespace restlab
