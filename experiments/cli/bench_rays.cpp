#include "experiments/cli/bench_rays.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "core/bench/stream.h"
#include "experiments/statistics/intervals.h"
#undef RL_KERNEL_BUFFERS
#undef RL_KERNEL_PARAMS
#include "core/bench/trace.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/runner/base/interrupt.h"

namespace restlab {

namespace {

// Returns a frame of at least `pixels` pixels, in whole workgroups.
rl::FrameData frameOf(size_t pixels) {
  rl::FrameData frame{};
  frame.width = 1024;
  frame.height = std::max(8u, static_cast<uint32_t>((pixels + 8191) / 8192 * 8));
  return frame;
}

// Returns the median time of a pass in seconds.
double secondsOf(Backend& backend, const PassRun& pass, const rl::FrameData& frame,
                 double seconds) {
  using Clock = std::chrono::steady_clock;
  StartupReport ignored;
  backend.prepare(pass, ignored);
  std::vector<double> times;
  const auto begin = Clock::now();
  do {
    throwIfInterrupted("the benchmark is not finished");
    backend.submit({pass}, frame);
    times.push_back(backend.collect().timesMs.front() * 1e-3);
  } while (times.size() < 3 ||
           std::chrono::duration<double>(Clock::now() - begin).count() < seconds);
  return median(times);
}

template <class Params>
std::vector<std::byte> bytesOf(const Params& params) {
  std::vector<std::byte> bytes(sizeof params);
  std::memcpy(bytes.data(), &params, sizeof params);
  return bytes;
}

// Allocates the buffers before the first pass runs, as backends place them together.
PassRun rayPass(Backend& backend, rl::FeatureMask mask, const std::vector<rl::Ray>& rays) {
  PassRun pass;
  pass.kernel = "trace";
  pass.mask = mask;
  pass.buffers = {backend.allocate(rays.size() * sizeof(rl::TraceQuery)),
                  backend.allocate(rays.size() * sizeof(rl::TraceResult))};
  pass.params = bytesOf(rl::TraceParams{static_cast<uint32_t>(rays.size())});
  return pass;
}

double rayRate(Backend& backend, const PassRun& pass, const std::vector<rl::Ray>& rays,
               uint32_t mode, double seconds) {
  if (rays.empty()) return 0.0;
  std::vector<rl::TraceQuery> queries;
  queries.reserve(rays.size());
  for (const rl::Ray& ray : rays) queries.push_back({ray, mode, 1, 0, 0});
  backend.write(pass.buffers[0], queries.data(), queries.size() * sizeof queries[0]);
  return double(rays.size()) / secondsOf(backend, pass, frameOf(rays.size()), seconds);
}

// Moves 64 MiB each way: more than any CPU cache.
rl::FrameData streamFrame() { return frameOf(size_t{1} << 20); }
size_t streamBytes() {
  const rl::FrameData frame = streamFrame();
  return size_t{frame.width} * frame.height * rl::RL_STREAM_UVEC4S * 16;
}

PassRun streamPass(Backend& backend) {
  PassRun pass;
  pass.kernel = "stream";
  pass.mask = backend.maskFor("stream", 0);
  pass.buffers = {backend.allocate(streamBytes()), backend.allocate(streamBytes())};
  pass.params = bytesOf(rl::StreamParams{0});
  return pass;
}

}  // namespace

BackendRates measureBackend(const PreparedScene& prepared, const std::string& name,
                            const BackendOptions& options, const RaySets& rays, double seconds) {
  const std::unique_ptr<Backend> backend = makeBackend(name, prepared.scene, options);
  const rl::FeatureMask mask = backend->maskFor("trace", prepared.scene->features());
  BackendRates rates;
  const PassRun primary = rayPass(*backend, mask, rays.primary);
  const PassRun incoherent = rayPass(*backend, mask, rays.incoherent);
  const PassRun shadow = rayPass(*backend, mask, rays.shadow);
  const PassRun stream = streamPass(*backend);
  rates.primary = rayRate(*backend, primary, rays.primary, rl::RL_RAY_PATH, seconds);
  rates.incoherent = rayRate(*backend, incoherent, rays.incoherent, rl::RL_RAY_PATH, seconds);
  rates.shadow = rayRate(*backend, shadow, rays.shadow, rl::RL_RAY_SHADOW, seconds);
  rates.bytesPerSecond =
      2.0 * double(streamBytes()) / secondsOf(*backend, stream, streamFrame(), seconds);
  return rates;
}

}  // namespace restlab
