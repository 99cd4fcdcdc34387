// Chooses the backend of a session, and logs its start-up.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/backend/backend.h"
#include "core/frame/session.h"

namespace restlab {

// Lists all of them; no backend supports every one.
const std::vector<std::string>& rayTracingNames();
// Returns whether the backend may support it. Only the session knows whether the device does.
bool mayTraceBy(const std::string& backend, const std::string& rayTracing);

// Device that methods of a table ran on.
struct DeviceUse {
  std::string backend, device, rayTracing;
  auto operator<=>(const DeviceUse&) const = default;
};
DeviceUse deviceUseOf(const Session& session);

// Logs the start-up of several sessions in few lines. A kernel that was ready before is in no
// report, so nothing is logged twice.
class StartupLog {
 public:
  // `before`: what the session had reported earlier; skipped.
  void add(const Session& session, const StartupReport& before = {});
  // Prints warnings, then "vulkan: 3 kernels ready in 2.4 s (2 from the cache) on ..." for each
  // device; with -v one line per kernel. Kernels of the CPU that all came from the cache are
  // details, too.
  void print();

 private:
  struct Entry {
    DeviceUse use;
    std::vector<KernelReport> kernels;
    double timeMs = 0.0;
  };
  std::vector<Entry> entries_;
  std::vector<std::string> notices_;
};

// For a single session.
void logStartup(const Session& session);

}  // namespace restlab
