// The CPU backend: Embree traces, TBB runs the tiles. Kernels are built in, or units.
#include <fmt/format.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include "core/backend/backend.h"
#include "core/backend/cpu_raster.h"
#include "core/backend/embree.h"
#include "core/backend/stop_scope.h"
#include "core/backend/units/kernel_units.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/scene/compiled/compiled_scene.h"

#ifndef RESTLAB_JTHREAD_TILES
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>
#endif

namespace restlab {

namespace {

constexpr uint32_t kTile = 16;

// Denormals are flushed inside kernels, whatever the caller's thread had set.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

class CpuBackend final : public Backend {
 public:
  CpuBackend(std::shared_ptr<const CompiledScene> scene, const BackendOptions& options)
      : scene_(std::move(scene)),
        rayTracing_(options.rayTracing.empty() ? "embree" : options.rayTracing),
        isExact_(options.exactKernels && rayTracing_ == "embree"),
        threads_(options.threads > 0
                     ? options.threads
                     : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())))
#ifndef RESTLAB_JTHREAD_TILES
        ,
        arena_(threads_)
#endif
  {
    if (!options.device.empty())
      failUsage("--device " + options.device + ": is of the Vulkan backend; the CPU has no choice");
    if (rayTracing_ != "embree" && rayTracing_ != "bvh") {
      failUsage(fmt::format("--ray-tracing {}: the CPU backend knows embree and bvh", rayTracing_));
    }
    if (rl::findCpuKernel("path", 0, rayTracing_.c_str()) == nullptr) {
      failUsage(
          fmt::format("--ray-tracing {}: its kernels for the CPU are built with the tests "
                      "(./lab test, or cmake -DRESTLAB_TESTS=ON); embree works",
                      rayTracing_));
    }
    bind();
  }

  void setScene(std::shared_ptr<const CompiledScene> scene) override {
    scene_ = std::move(scene);
    bind();
  }

  void requireMemory(const std::string& what, uint32_t width, uint32_t height, uint64_t bufferBytes,
                     uint64_t hostBytes) const override {
    restlab::requireMemory(what, width, height, bufferBytes + hostBytes);
  }

  BufferId allocate(size_t bytes) override {
    try {
      buffers_.emplace_back(bytes, std::byte{0});
    } catch (const std::bad_alloc&) {
      size_t total = 0;
      for (const auto& b : buffers_) total += b.size();
      throw Error(
          ExitCode::deviceUnavailable,
          fmt::format(
              "out of memory: a buffer of {} MiB beside {} MiB already allocated; choose a smaller "
              "resolution",
              bytes >> 20, total >> 20));
    }
    return static_cast<BufferId>(buffers_.size() - 1);
  }

  void clear(BufferId buffer) override {
    std::fill(buffers_[buffer].begin(), buffers_[buffer].end(), std::byte{0});
  }

  void write(BufferId buffer, const void* from, size_t bytes) override {
    std::memcpy(buffers_[buffer].data(), from, bytes);
  }

  void read(BufferId buffer, void* to, size_t bytes) override {
    std::memcpy(to, buffers_[buffer].data(), bytes);
  }

  void copy(const std::vector<std::pair<BufferId, BufferId>>& buffers) override {
    for (const auto& [from, to] : buffers)
      std::memcpy(buffers_[to].data(), buffers_[from].data(), buffers_[from].size());
  }

  // A unit of its own where no built-in kernel has exactly these features.
  rl::FeatureMask maskFor(const std::string& kernel, rl::FeatureMask needed) const override {
    const rl::FeatureMask builtIn = findBuiltIn(kernel, needed).mask;
    if (!isExact_ || !hasFeatures(kernel)) return builtIn;
    const bool isReady = kernelUnits().find({kernel, needed}) != nullptr;
    if (isReady || builtIn == needed || kernelUnits().areThere()) return needed;
    lacksUnits_ = true;
    return builtIn;
  }

  bool compile(const std::vector<KernelUse>& kernels, StartupReport& report) override {
    std::vector<KernelUnit> units;
    for (const KernelUse& use : kernels) {
      if (isExact_ && findBuiltIn(use.kernel, use.mask).mask != use.mask)
        units.push_back({use.kernel, use.mask});
    }
    const bool isWhole = units.empty() || kernelUnits().prepare(units, report);
    if (lacksUnits_) kernelUnits().notice(report);
    return isWhole;
  }

  size_t codeBytes(const KernelUse& use) const override {
    return isExact_ ? kernelUnits().codeBytes({use.kernel, use.mask}) : 0;
  }

  void prepare(const PassRun& pass, StartupReport& report) override {
    compile({{pass.kernel, pass.mask}}, report);
    if (pass.isRaster()) compile({pass.vertices}, report);
  }

  void submit(const std::vector<PassRun>& passes, const rl::FrameData& frame) override {
    FrameResult result;
    size_t tiles = 0;
    for (const PassRun& pass : passes)
      if (!pass.isRaster()) tiles += tileCount(tilesOf(pass.size(frame)));
    setWork(0, tiles);
    for (const PassRun& pass : passes)
      result.timesMs.push_back(run(pass, frame, result.counters.emplace_back()));
    finished_.push_back(std::move(result));
  }

  FrameResult collect() override {
    FrameResult result = std::move(finished_.front());
    finished_.pop_front();
    return result;
  }

  uint32_t framesInFlight() const override { return 1; }
  std::string rayTracing() const override { return rayTracing_; }
  std::string device() const override { return cpuBackendInfo().description; }

 private:
  void bind() const {
    if (rayTracing_ == "bvh") scene_->bindBvh();
  }

  const rl::CpuKernelInfo& findBuiltIn(const std::string& kernel, rl::FeatureMask needed) const {
    const rl::CpuKernelInfo* info = rl::findCpuKernel(kernel.c_str(), needed, rayTracing_.c_str());
    if (info == nullptr) failUsage("no kernel '" + kernel + "' in this build");
    return *info;
  }

  // The kernel with exactly the mask, or a built-in one with more features.
  rl::CpuKernelEntry find(const std::string& kernel, rl::FeatureMask mask) const {
    const rl::CpuKernelInfo& builtIn = findBuiltIn(kernel, mask);
    if (builtIn.mask == mask) return builtIn.entry;
    const rl::CpuKernelEntry unit = kernelUnits().find({kernel, mask});
    return unit != nullptr ? unit : builtIn.entry;
  }

  // Arguments of every kernel of a pass.
  struct Call {
    rl::FrameData frame;
    std::vector<void*> addresses;
    rl::CpuKernelArgs args;
  };

  void fill(Call& call, const PassRun& pass, const rl::FrameData& frame) {
    for (BufferId b : pass.buffers)
      call.addresses.push_back(b == kNoBuffer ? nullptr : buffers_[b].data());
    call.frame = frame;
    if (drawnLights_ != kNoBuffer)
      call.frame.drawnLights.data = reinterpret_cast<uint32_t*>(buffers_[drawnLights_].data());
    call.args.scene = &scene_->data();
    call.args.frame = &call.frame;
    call.args.buffers = call.addresses.data();
    call.args.params = pass.params.data();
    call.args.embreeScene = scene_->embreeScene();
  }

  double run(const PassRun& pass, const rl::FrameData& frame, PassCounters& counters) {
    Call call;
    fill(call, pass, frame);
    const auto start = std::chrono::steady_clock::now();
    if (pass.isRaster())
      rasterise(pass, call, counters);
    else
      runTiles(find(pass.kernel, pass.mask), call.args, pass.size(frame), counters);
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(end - start).count();
  }

  static void add(const rl::CpuKernelCounters& from, PassCounters& to) {
    to.raysPath += from.raysPath;
    to.raysShadow += from.raysShadow;
    for (uint32_t k = 0; k < rl::RL_HEALTH_COUNT; ++k) to.health[k] += from.health[k];
  }

  static glm::uvec2 tilesOf(const glm::uvec2& size) { return (size + (kTile - 1)) / kTile; }
  static size_t tileCount(const glm::uvec2& tiles) { return size_t(tiles.x) * tiles.y; }

  void runTiles(rl::CpuKernelEntry entry, const rl::CpuKernelArgs& args, const glm::uvec2& size,
                PassCounters& counters) {
    const glm::uvec2 tiles = tilesOf(size);
    std::vector<rl::CpuKernelCounters> tileCounters(tileCount(tiles));
    forEachTile(tileCounters.size(), [&](size_t i) {
      const auto tx = static_cast<uint32_t>(i % tiles.x), ty = static_cast<uint32_t>(i / tiles.x);
      const rl::CpuKernelTile tile{tx * kTile, ty * kTile, std::min((tx + 1) * kTile, size.x),
                                   std::min((ty + 1) * kTile, size.y)};
      // Counted locally: neighbouring entries of the vector share cache lines.
      rl::CpuKernelCounters local;
      entry(args, tile, local);
      tileCounters[i] = local;
      addWork();
    });
    for (const rl::CpuKernelCounters& c : tileCounters) add(c, counters);
  }

  // Runs both stages of a raster pass: kernels over corners, and over fragments that ask.
  void rasterise(const PassRun& pass, const Call& call, PassCounters& counters) {
    rl::RasterParams params;
    std::memcpy(&params, pass.params.data(), sizeof params);
    rl::RasterBuffers given;
    std::memcpy(&given, call.addresses.data(), sizeof given);
    const rl::CpuKernelEntry vertices = find(pass.vertices.kernel, pass.vertices.mask);
    const rl::CpuKernelEntry fragments = find(pass.kernel, pass.mask);
    // Calls a stage with what it exchanges with the rasteriser.
    const auto with = [&](const rl::RasterBuffers& exchanged, const auto& run) {
      std::vector<void*> addresses = call.addresses;
      rl::RasterBuffers buffers = exchanged;
      buffers.hits = given.hits;
      buffers.diffuse = given.diffuse;
      buffers.highlight = given.highlight;
      buffers.boxes = given.boxes;
      std::memcpy(addresses.data(), &buffers, sizeof buffers);
      rl::CpuKernelArgs args = call.args;
      args.buffers = addresses.data();
      run(args);
    };
    std::mutex mutex;  // guards the counters of fragments
    RasterStages stages;
    stages.vertices = [&](const rl::RasterBuffers& exchanged, uint32_t corners) {
      const uint32_t row = rl::RL_ENTRY_ROW;
      with(exchanged, [&](const rl::CpuKernelArgs& args) {
        if (corners >= row) runTiles(vertices, args, {row, corners / row}, counters);
        const FlushDenormals flush;
        rl::CpuKernelCounters rest;
        vertices(args, {0, corners / row, corners % row, corners / row + 1}, rest);
        add(rest, counters);
      });
    };
    stages.fragments = [&](const rl::RasterBuffers& exchanged, uint32_t count) {
      rl::CpuKernelCounters local;
      with(exchanged, [&](const rl::CpuKernelArgs& args) {
        fragments(args, {0, 0, count, 1}, local);
      });
      const std::lock_guard lock(mutex);
      add(local, counters);
    };
    stages.parallel = [&](size_t count, const std::function<void(size_t)>& run) {
      forEachTile(count, run);
    };
    restlab::rasterise({scene_->bvhInput().geometries, scene_->bvhInput().instances},
                       {{call.frame.width, call.frame.height},
                        reinterpret_cast<glm::uvec4*>(given.hits.data),
                        reinterpret_cast<glm::vec4*>(given.diffuse.data),
                        reinterpret_cast<glm::vec4*>(given.highlight.data)},
                       params, stages);
  }

  // Calls `run` for 0 to count - 1 on all threads. Throws FrameStopped if some were left out.
  template <typename F>
  void forEachTile(size_t count, const F& run) {
    std::atomic<bool> isLeftOut = false;
    const StopFlag flag = stopFlag();
    forEach(count, [&](size_t i) {
      const StopScope stops(flag);
      if (isStopped()) {
        isLeftOut = true;
        return;
      }
      const FlushDenormals flush;
      run(i);
    });
    if (isLeftOut) throw FrameStopped();
  }

#ifdef RESTLAB_JTHREAD_TILES
  template <typename F>
  void forEach(size_t count, const F& run) {
    std::atomic<size_t> next{0};
    std::vector<std::jthread> workers;
    for (int t = 0; t < threads_; ++t) {
      workers.emplace_back([&] {
        for (size_t i = next++; i < count; i = next++) run(i);
      });
    }
  }
#else
  template <typename F>
  void forEach(size_t count, const F& run) {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<size_t>(0, count, 1),
          [&](const tbb::blocked_range<size_t>& r) {
            for (size_t i = r.begin(); i < r.end(); ++i) run(i);
          },
          tbb::simple_partitioner());
    });
  }
#endif

  std::shared_ptr<const CompiledScene> scene_;
  std::string rayTracing_;
  bool isExact_;
  mutable bool lacksUnits_ = false;  // a built-in kernel serves where a unit was wanted
  int threads_;
#ifndef RESTLAB_JTHREAD_TILES
  tbb::task_arena arena_;
#endif
  std::vector<std::vector<std::byte>> buffers_;
  std::deque<FrameResult> finished_;
};

}  // namespace

std::unique_ptr<Backend> makeCpuBackend(std::shared_ptr<const CompiledScene> scene,
                                        const BackendOptions& options) {
  return std::make_unique<CpuBackend>(std::move(scene), options);
}

BackendInfo cpuBackendInfo() {
  BackendInfo info;
  info.name = "cpu";
#ifdef RESTLAB_JTHREAD_TILES
  const std::string tiles = "std::jthread tiles";
#else
  const std::string tiles = fmt::format("TBB {}.{} tiles", TBB_VERSION_MAJOR, TBB_VERSION_MINOR);
#endif
  info.description = fmt::format("Embree {}, {}, {} threads", RTC_VERSION_STRING, tiles,
                                 std::thread::hardware_concurrency());
  return info;
}

bool hasFeatures(const std::string& kernel) {
  const rl::CpuKernelTable table = rl::cpuKernelTable();
  const auto rowsOf = [&](const std::string& name) {
    return std::count_if(table.rows, table.rows + table.count, [&](const rl::CpuKernelInfo& row) {
      return row.name == name && std::strcmp(row.trace, "embree") == 0;
    });
  };
  // A build without masks has one row for every kernel: each may need any feature there.
  return rowsOf(kernel) > 1 || rowsOf("gbuffer") == 1;
}

}  // namespace restlab

namespace rl {

namespace {

CpuKernelTable& registeredKernels() {
  static CpuKernelTable table{};
  return table;
}

}  // namespace

CpuKernelTable cpuKernelTable() { return registeredKernels(); }

bool registerCpuKernels(CpuKernelTable table) {
  registeredKernels() = table;
  return true;
}

const CpuKernelInfo* findCpuKernel(const char* name, FeatureMask needed, const char* trace) {
  const CpuKernelTable table = cpuKernelTable();
  const CpuKernelInfo* best = nullptr;
  for (uint32_t i = 0; i < table.count; ++i) {
    const CpuKernelInfo& row = table.rows[i];
    if (std::strcmp(row.name, name) != 0 || std::strcmp(row.trace, trace) != 0 ||
        (row.mask & needed) != needed)
      continue;
    if (best == nullptr || std::popcount(row.mask) < std::popcount(best->mask)) best = &row;
  }
  return best;
}

}  // namespace rl

#ifdef RESTLAB_JTHREAD_TILES
// Suppresses reports from Embree and TBB: Embree builds its hierarchies on the distribution's TBB,
// whose synchronisation this sanitizer does not see. Only our own code is checked, which runs on
// std::jthread here.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libembree\nrace:libembree\nrace:libtbb.so\n";
}
#endif
