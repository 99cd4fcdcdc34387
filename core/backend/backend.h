// A backend runs kernels over pixels: it owns the buffers, runs the passes of a frame and times
// them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/cpu_kernel.h"
#include "core/backend/stop.h"
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
  // One line per device: what it is and supports. Empty if the backend has but one.
  std::vector<std::string> devices;
};

// Options of how a session's kernels are run.
struct BackendOptions {
  int threads = 0;         // CPU backend; 0: all cores
  std::string device;      // Vulkan backend: part of the device's name; "": the preferred one
  std::string rayTracing;  // "embree", "bvh", "query"; "": the backend's best
  bool validate = false;   // Vulkan's validation layers
  // CPU backend: kernels may be compiled for exactly what a scene needs.
  bool exactKernels = false;
};

// A kernel that was made ready for a device.
struct KernelReport {
  std::string kernel;
  rl::FeatureMask mask = 0;
  bool fromDisk = false;   // the SPIR-V, or the CPU's code, came from the disk cache
  double compileMs = 0.0;  // dialect to SPIR-V, or to the CPU's code
  double driverMs = 0.0;   // SPIR-V to code
};

// Work that a session did before its first frame.
struct StartupReport {
  double timeMs = 0.0;  // until kernels were compiled; 0 if they were compiled with the program
  std::vector<KernelReport> kernels;
  bool readsTexels = false;          // a kernel reads through texels, not by address
  std::vector<std::string> notices;  // one line each, for the user
};

// A kernel for a mask of features.
struct KernelUse {
  std::string kernel;
  rl::FeatureMask mask = 0;
};

// One pass of a frame: a kernel over all pixels, or over entries.
struct PassRun {
  std::string kernel;
  rl::FeatureMask mask = 0;
  // In the order of the kernel's Buffers struct; kNoBuffer binds null.
  std::vector<BufferId> buffers;
  std::vector<std::byte> params;
  uint32_t entries = 0;  // 0: the pass runs over pixels
  // Vertex stage of a raster pass, whose fragment stage is `kernel` and whose first buffers and
  // parameters are those of core/raster/raster.h; no name: it is no raster pass.
  KernelUse vertices = {};

  bool isRaster() const { return !vertices.kernel.empty(); }
  glm::uvec2 size(const rl::FrameData& frame) const {
    if (entries == 0) return {frame.width, frame.height};
    return {rl::RL_ENTRY_ROW, (entries + rl::RL_ENTRY_ROW - 1) / rl::RL_ENTRY_ROW};
  }
};

struct FrameResult {
  std::vector<double> timesMs;         // per pass
  std::vector<PassCounters> counters;  // per pass
};

class Backend {
 public:
  virtual ~Backend() = default;

  // Throws Error (deviceUnavailable) with the sizes if width x height pixels do not fit.
  // bufferBytes: per pixel, in buffers here; hostBytes: per pixel, beside them on the host.
  virtual void requireMemory(const std::string& what, uint32_t width, uint32_t height,
                             uint64_t bufferBytes, uint64_t hostBytes) const = 0;
  // Zeroed memory; throws Error (deviceUnavailable) with the sizes when there is not enough.
  virtual BufferId allocate(size_t bytes) = 0;
  virtual void clear(BufferId buffer) = 0;
  virtual void write(BufferId buffer, const void* from, size_t bytes) = 0;
  virtual void read(BufferId buffer, void* to, size_t bytes) = 0;
  // Copies each first buffer to its second one, of the same size.
  virtual void copy(const std::vector<std::pair<BufferId, BufferId>>& buffers) = 0;

  // The mask of the specialisation that serves `needed`; throws Error (badUsage) for unknown
  // kernels.
  virtual rl::FeatureMask maskFor(const std::string& kernel, rl::FeatureMask needed) const = 0;
  // Compiles kernels with the masks that maskFor() gave, where that takes long and several can be
  // compiled at once. Returns false if one cannot be compiled: maskFor() then gives masks of
  // kernels that are there.
  virtual bool compile(const std::vector<KernelUse>&, StartupReport&) { return true; }
  // Bytes of machine code of a kernel that was compiled for the scene; 0: it is built in, or the
  // device does not tell.
  virtual size_t codeBytes(const KernelUse&) const { return 0; }
  // Makes a pass ready to run, so that no frame has to wait for a compiler.
  virtual void prepare(const PassRun& pass, StartupReport& report) = 0;

  // Sets the scene of later frames, which must differ in its light alone
  // (CompiledScene::differsInLightAlone). Keeps buffers and waits for frames under way.
  virtual void setScene(std::shared_ptr<const CompiledScene> scene) = 0;

  // Buffer that later frames see as FrameData::drawnLights.
  void tellDrawnLights(BufferId buffer) { drawnLights_ = buffer; }

  // Starts a frame: the passes one after another. Waits if framesInFlight() frames are under way
  // already.
  virtual void submit(const std::vector<PassRun>& passes, const rl::FrameData& frame) = 0;
  // Waits for the oldest frame under way.
  virtual FrameResult collect() = 0;
  virtual uint32_t framesInFlight() const = 0;
  // Ends frames under way in their middle while isWanted() is true, as a signal does: submit() or
  // collect() then throws FrameStopped. Several threads call isWanted() often. Empty: signals
  // alone.
  void stopWhere(std::function<bool()> isWanted) { isStopWanted_ = std::move(isWanted); }

  // Done fraction of the work of the frame under way: of its tiles or commands, which need not take
  // the same time. Callable from any thread.
  double frameFraction() const {
    const size_t whole = workWhole_;
    return whole > 0 ? std::min(1.0, double(workDone_) / double(whole)) : 0.0;
  }

  virtual std::string rayTracing() const = 0;  // the method in use
  virtual std::string device() const = 0;      // description for reports

 protected:
  BufferId drawnLights_ = kNoBuffer;

  void setWork(size_t done, size_t whole) {
    workDone_ = done;
    workWhole_ = whole;
  }
  void addWork() { workDone_.fetch_add(1, std::memory_order_relaxed); }
  bool isStopped() const { return framesStopped() || (isStopWanted_ && isStopWanted_()); }

 private:
  std::function<bool()> isStopWanted_;
  std::atomic<size_t> workDone_ = 0, workWhole_ = 0;
};

std::unique_ptr<Backend> makeCpuBackend(std::shared_ptr<const CompiledScene> scene,
                                        const BackendOptions& options);
BackendInfo cpuBackendInfo();
std::unique_ptr<Backend> makeVulkanBackend(const std::shared_ptr<const CompiledScene>& scene,
                                           const BackendOptions& options);
BackendInfo vulkanBackendInfo();

// Returns whether a kernel is compiled for several feature masks.
bool hasFeatures(const std::string& kernel);

// Names of all backends; nothing is opened.
const std::vector<std::string>& backendNames();
// All backends, for `restlab list backends`.
std::vector<BackendInfo> backendRegistry();
// Throws Error (badUsage) for an unknown name, (deviceUnavailable) where it cannot run here.
std::unique_ptr<Backend> makeBackend(const std::string& name,
                                     std::shared_ptr<const CompiledScene> scene,
                                     const BackendOptions& options);

}  // namespace restlab
