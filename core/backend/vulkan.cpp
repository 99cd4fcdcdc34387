// The Vulkan backend: kernels as compute shaders. Passes are recorded once and replayed; what
// changes from frame to frame (frame data, buffer addresses, parameters) lies in memory that the
// host writes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <map>
#include <tuple>

#include "core/backend/backend.h"
#include "core/backend/dialect_sources.h"
#include "core/backend/stop.h"
#include "core/backend/vulkan_buffers.h"
#include "core/backend/vulkan_context.h"
#include "core/backend/vulkan_parts.h"
#include "core/backend/vulkan_raster.h"
#include "core/backend/vulkan_reads.h"
#include "core/backend/vulkan_recording.h"
#include "core/backend/vulkan_scene.h"
#include "core/backend/vulkan_slot.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

namespace {

constexpr uint32_t kSlots = 2;  // frames in flight
// Pixels of a dispatch before its time is known: on a graphics card, and on a software driver.
constexpr uint32_t kFirstBandPixels = 1u << 18;
constexpr uint32_t kFirstBandPixelsOfCpu = 1u << 16;
constexpr double kLongestBandMs = 500.0;  // watchdogs end dispatches of a few seconds

class VulkanBackend final : public Backend {
 public:
  VulkanBackend(const std::shared_ptr<const CompiledScene>& scene, const BackendOptions& options)
      : context_(VulkanContext::of({options.device, options.validate})),
        device_(*context_->device),
        memory_(*context_->memory),
        buffers_(context_->memory),
        raster_(context_->device, context_->kernels) {
    const bool hasQuery = device_.info().hasRayQuery;
    const bool hasShapes = (scene->features() & rl::RL_FEATURE_SHAPES) != 0;
    rayTracing_ = options.rayTracing;
    // Software drivers trace faster by the hierarchy that kernels traverse themselves.
    if (rayTracing_.empty())
      rayTracing_ = hasQuery && device_.info().kind != "cpu" && !hasShapes ? "query" : "bvh";
    if (rayTracing_ != "bvh" && rayTracing_ != "query") {
      failUsage(
          fmt::format("--ray-tracing {}: the Vulkan backend knows bvh and query", rayTracing_));
    }
    rays_ = rayTracing_ == "query" ? SceneRays::query : SceneRays::bvh;
    if (rays_ == SceneRays::query && hasShapes)
      failUsage(
          "--ray-tracing query: ray queries meet triangles alone, and the scene has shapes; "
          "--ray-tracing bvh works");
    if (rays_ == SceneRays::query && !hasQuery) {
      throw Error(ExitCode::deviceUnavailable,
                  fmt::format("--ray-tracing query: {} has no ray queries; --ray-tracing bvh works",
                              device_.name()));
    }
    trace_ = rays_ == SceneRays::query ? kGlslTraceQuery : kGlslTraceBvh;
    scene_ = VulkanScene::of(context_->memory, scene, rays_);
    for (Slot& slot : slots_) {
      slot.inputs = memory_.allocate(kInputBytes, MemoryKind::upload);
      slot.counters = memory_.allocate(kCounterBytes, MemoryKind::readback);
      slot.parts.create(device_);
    }
  }

  ~VulkanBackend() override {
    vkDeviceWaitIdle(device_.handle());
    for (Slot& slot : slots_) {
      forget(slot);
      context_->kernels->release(slot.bound);
      slot.parts.destroy(device_);
      memory_.free(slot.inputs);
      memory_.free(slot.counters);
    }
  }

  void requireMemory(const std::string& what, uint32_t width, uint32_t height, uint64_t bufferBytes,
                     uint64_t hostBytes) const override {
    const bool isHost = device_.info().kind == "cpu";
    restlab::requireMemory(what, width, height, hostBytes + (isHost ? bufferBytes : 0));
    const uint64_t pixels = uint64_t(width) * height;
    const uint64_t available = memory_.bytesAvailable(MemoryKind::device);
    if (bufferBytes == 0 || pixels <= available / bufferBytes) return;
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("{}: {}x{} pixels of {} bytes need {:.0f} MiB of the memory of {}, {} "
                            "MiB are available; choose a smaller resolution",
                            what, width, height, bufferBytes,
                            double(pixels) * double(bufferBytes) / double(1 << 20), device_.name(),
                            available >> 20));
  }

  BufferId allocate(size_t bytes) override { return buffers_.allocate(bytes); }
  void clear(BufferId buffer) override {
    placeBuffers();
    memory_.clear(buffers_[buffer]);
  }
  void write(BufferId buffer, const void* from, size_t bytes) override {
    placeBuffers();
    memory_.write(buffers_[buffer], from, bytes);
  }
  void read(BufferId buffer, void* to, size_t bytes) override {
    placeBuffers();
    memory_.read(buffers_[buffer], to, bytes);
  }
  void copy(const std::vector<std::pair<BufferId, BufferId>>& buffers) override {
    placeBuffers();
    std::vector<std::pair<GpuBuffer, GpuBuffer>> pairs;
    for (const auto& [from, to] : buffers) pairs.emplace_back(buffers_[from], buffers_[to]);
    memory_.copy(pairs);
  }

  void setScene(std::shared_ptr<const CompiledScene> scene) override {
    while (!underWay_.empty()) finished_.push_back(finishOldest());
    scene_ = VulkanScene::of(context_->memory, scene, rays_);
    for (Slot& slot : slots_) forget(slot);  // recordings and texels refer to the old scene
    if (buffers_.isPlaced()) bindTexels();
  }

  rl::FeatureMask maskFor(const std::string& kernel, rl::FeatureMask needed) const override {
    dialectKernel(kernel);
    return needed;  // compiled on demand, with exactly the needed mask
  }

  void prepare(const PassRun& pass, StartupReport& report) override {
    placeBuffers();
    report.readsTexels = report.readsTexels || readsTexels(pass);
    pipelineOf(pass, report);
  }

  void submit(const std::vector<PassRun>& passes, const rl::FrameData& frame) override {
    placeBuffers();
    FrameResult before;
    auto first = passes.begin();
    for (; size_t(passes.end() - first) > kMostPasses; first += kMostPasses) {
      while (!underWay_.empty()) finished_.push_back(finishOldest());
      submitPart({first, first + kMostPasses}, frame, std::move(before));
      before = finishOldest();
    }
    submitPart({first, passes.end()}, frame, std::move(before));
  }

  FrameResult collect() override {
    if (finished_.empty()) return finishOldest();
    FrameResult result = finished_.front();
    finished_.pop_front();
    return result;
  }

  uint32_t framesInFlight() const override { return VulkanParts::givesBands(device_) ? 1 : kSlots; }
  std::string rayTracing() const override { return rayTracing_; }
  std::string device() const override {
    return fmt::format("{}, {}", device_.name(), device_.info().driver);
  }

 private:
  // Submits passes of a frame; `before`: results of those before them.
  void submitPart(const std::vector<PassRun>& passes, const rl::FrameData& frame,
                  FrameResult before) {
    if (underWay_.size() == framesInFlight()) finished_.push_back(finishOldest());
    Slot& slot = slots_[next_];
    next_ = (next_ + 1) % kSlots;
    RecordingKey key;
    StartupReport ignored;
    for (const PassRun& pass : passes) {
      const glm::uvec2 size = pass.size(frame);
      key.pipelines.push_back(pipelineOf(pass, ignored));
      key.sizes.push_back({size.x, size.y});
      key.targets.push_back(VulkanRaster::targetsOf(pass));
      key.divisions.push_back(VulkanRaster::divisionsOf(pass));
    }
    slot.before = std::move(before);
    writeInputs(slot, passes, frame);
    if (slot.isStale) forget(slot);
    auto found = slot.recordings.find(key);
    if (found == slot.recordings.end())
      found = slot.recordings.emplace(key, record(slot, key)).first;
    slot.running = &found->second;
    slot.runningKey = key;
    std::memset(slot.counters.mapped, 0, kCounterBytes);
    slot.started = std::chrono::steady_clock::now();
    slot.parts.begin(device_, slot.running->commands);
    underWay_.push_back(&slot);
  }

  VkPipeline pipelineOf(const PassRun& pass, StartupReport& report) {
    if (pass.isRaster()) return raster_.pipeline(pass, trace_, report);
    const bool texels = readsTexels(pass);
    VkPipeline& known = pipelines_[{pass.kernel, pass.mask, texels}];
    if (known == VK_NULL_HANDLE) {
      const DialectKernel& files = dialectKernel(pass.kernel);
      known = context_->kernels->pipeline(
          {files.header, files.file, trace_.file, trace_.extensions, texels}, pass.kernel,
          pass.mask, dialectSource, report);
    }
    return known;
  }

  // Called at the first use of any buffer.
  void placeBuffers() {
    if (buffers_.isPlaced()) return;
    readsTexels_ = choosesTexels(device_, scene_->arrays(), buffers_.bytes());
    buffers_.place(readsTexels_);
    bindTexels();
  }

  void bindTexels() {
    if (!readsTexels_) return;
    for (Slot& slot : slots_) {
      context_->kernels->release(slot.bound);
      const auto part = [&](size_t begin, size_t bytes) {
        return VulkanMemory::part(slot.inputs, begin, bytes);
      };
      slot.bound = context_->kernels->bind(
          {scene_->data(), part(0, kPassOffset), part(kPassOffset, kPassParams),
           part(kPassOffset + kPassParams, kPassBytes - kPassParams), *scene_->arrays(),
           buffers_.together()});
    }
  }

  // Texels reach only buffers that were placed together; a pass with others reads by address.
  bool readsTexels(const PassRun& pass) const {
    return readsTexels_ && buffers_.areTogether(pass.buffers);
  }

  static size_t passOffset(size_t pass) { return kPassOffset + pass * kPassBytes; }

  void writeInputs(Slot& slot, const std::vector<PassRun>& passes, const rl::FrameData& frame) {
    rl::FrameData seen = frame;
    const uint64_t drawn = drawnLights_ == kNoBuffer ? 0 : buffers_[drawnLights_].address;
    std::memcpy(&seen.drawnLights, &drawn, sizeof drawn);
    std::memcpy(slot.inputs.mapped, &seen, sizeof seen);
    for (size_t i = 0; i < passes.size(); ++i) {
      std::vector<uint64_t> addresses;
      for (BufferId b : passes[i].buffers)
        addresses.push_back(b == kNoBuffer ? 0 : buffers_[b].address);
      std::byte* at = slot.inputs.mapped + passOffset(i);
      const size_t addressBytes = addresses.size() * sizeof(uint64_t);
      const size_t paramBytes = passes[i].params.size();
      if (addressBytes > kPassParams || paramBytes > kPassBytes - kPassParams || i >= kMostPasses) {
        throw std::logic_error("a pass has more buffers or parameters than a slot holds");
      }
      std::memcpy(at, addresses.data(), addressBytes);
      std::memcpy(at + kPassParams, passes[i].params.data(), paramBytes);
    }
  }

  Recording record(Slot& slot, const RecordingKey& key) {
    Recording recording;
    for (uint32_t pass = 0; pass < key.pipelines.size(); ++pass) {
      if (!key.targets[pass].empty()) {
        recording.bands.push_back({pass, 0, 1});
        continue;
      }
      const uint32_t groupsX = key.groups(pass, 0), groupsY = key.groups(pass, 1);
      // Limit the bands to the number of counters.
      const auto most =
          static_cast<uint32_t>(kCounterBytes / sizeof(GlslCounters) / key.pipelines.size());
      const uint32_t rows =
          std::max(rowsPerBand(key.pipelines[pass], groupsX), (groupsY + most - 1) / most);
      for (uint32_t row = 0; row < groupsY; row += rows)
        recording.bands.push_back({pass, row, std::min(rows, groupsY - row)});
    }
    if (recording.bands.size() * sizeof(GlslCounters) > kCounterBytes)
      throw std::logic_error("a frame has more dispatches than a slot has counters");
    const auto bandCount = static_cast<uint32_t>(recording.bands.size());
    if (device_.hasTimestamps()) {
      VkQueryPoolCreateInfo queries{};
      queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
      queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
      queries.queryCount = 2 * bandCount;
      device_.check(vkCreateQueryPool(device_.handle(), &queries, nullptr, &recording.queries),
                    "vkCreateQueryPool");
    }
    for (uint32_t band = 0; band < bandCount; ++band) {
      recording.commands.push_back(recordBand(slot, key, recording, band));
    }
    return recording;
  }

  VkCommandBuffer recordBand(const Slot& slot, const RecordingKey& key, const Recording& recording,
                             uint32_t index) {
    const Band& band = recording.bands[index];
    VkCommandBuffer commands = device_.newCommands();
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    device_.check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    if (index == 0 && recording.queries != VK_NULL_HANDLE) {
      const auto count = static_cast<uint32_t>(2 * recording.bands.size());
      vkCmdResetQueryPool(commands, recording.queries, 0, count);
    }
    GlslPushConstants push;
    push.scene = scene_->address();
    push.frame = slot.inputs.address;
    push.buffers = slot.inputs.address + passOffset(band.pass);
    push.params = push.buffers + kPassParams;
    push.counters = slot.counters.address + index * sizeof(GlslCounters);
    push.sceneBase = readsTexels_ ? scene_->arrays()->address : 0;
    push.stateBase = buffers_.together().address;
    push.width = key.sizes[band.pass][0];
    push.height = key.sizes[band.pass][1];
    if (key.targets[band.pass].empty())
      recordDispatch(commands, slot, key, recording, index, push);
    else
      recordRaster(commands, key, recording, index, push);
    VkMemoryBarrier after{};
    after.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    after.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    after.dstAccessMask = VK_ACCESS_HOST_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
    VkPipelineStageFlags writing = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    if (!key.targets[band.pass].empty()) {
      after.srcAccessMask |= VK_ACCESS_TRANSFER_WRITE_BIT;
      writing = VulkanRaster::kWritingStages;
    }
    vkCmdPipelineBarrier(commands, writing,
                         VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &after,
                         0, nullptr, 0, nullptr);
    device_.check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    return commands;
  }

  void recordDispatch(VkCommandBuffer commands, const Slot& slot, const RecordingKey& key,
                      const Recording& recording, uint32_t index, const GlslPushConstants& push) {
    const Band& band = recording.bands[index];
    // Wait for the other passes, and for clears or copies between frames.
    VkMemoryBarrier before{};
    before.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    before.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    before.dstAccessMask =
        VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT;
    vkCmdPipelineBarrier(
        commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &before, 0, nullptr, 0, nullptr);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, key.pipelines[band.pass]);
    if (slot.bound.set != VK_NULL_HANDLE) {
      const auto offset = static_cast<uint32_t>(band.pass * kPassBytes);
      std::array<uint32_t, kGlslDynamicOffsets> offsets{};
      offsets.fill(offset);
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, context_->kernels->layout(),
                              0, 1, &slot.bound.set, offsets.size(), offsets.data());
    }
    vkCmdPushConstants(commands, context_->kernels->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       sizeof push, &push);
    timestamp(commands, recording, 2 * index);
    vkCmdDispatchBase(commands, 0, band.firstRow, 0, key.groups(band.pass, 0), band.rows, 1);
    timestamp(commands, recording, 2 * index + 1);
  }

  void recordRaster(VkCommandBuffer commands, const RecordingKey& key, const Recording& recording,
                    uint32_t index, const GlslPushConstants& push) {
    const uint32_t pass = recording.bands[index].pass;
    if (VulkanParts::givesBands(device_)) context_->hasTrueTimestamps = false;
    std::vector<GpuBuffer> targets;
    for (const BufferId target : key.targets[pass]) targets.push_back(buffers_[target]);
    timestamp(commands, recording, 2 * index, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT);
    raster_.record(commands, key.pipelines[pass], targets, scene_->source(), key.divisions[pass],
                   push);
    timestamp(commands, recording, 2 * index + 1, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT);
  }

  static void timestamp(VkCommandBuffer commands, const Recording& recording, uint32_t query,
                        VkPipelineStageFlagBits stage = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT) {
    if (recording.queries != VK_NULL_HANDLE)
      vkCmdWriteTimestamp(commands, stage, recording.queries, query);
  }

  uint32_t rowsPerBand(VkPipeline pipeline, uint32_t groupsX) {
    const auto found = bandPixels_.find(pipeline);
    const bool isCpu = device_.info().kind == "cpu";
    const uint32_t first = isCpu ? kFirstBandPixelsOfCpu : kFirstBandPixels;
    const uint32_t pixels = found == bandPixels_.end() ? first : found->second;
    return std::max(1u, pixels / (groupsX * kGlslTile * kGlslTile));
  }

  void forget(Slot& slot) {
    for (auto& entry : slot.recordings) release(entry.second);
    slot.recordings.clear();
    slot.isStale = false;
  }

  void release(Recording& recording) {
    for (VkCommandBuffer commands : recording.commands) device_.freeCommands(commands);
    if (recording.queries != VK_NULL_HANDLE)
      vkDestroyQueryPool(device_.handle(), recording.queries, nullptr);
  }

  FrameResult finishOldest() {
    if (underWay_.empty()) throw std::logic_error("no frame is under way");
    Slot& slot = *underWay_.front();
    underWay_.pop_front();
    waitFor(slot);
    const double wallMs =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - slot.started)
            .count();
    device_.throwValidationMessages();
    const Recording& recording = *slot.running;
    FrameResult result = std::move(slot.before);
    const size_t earlier = result.timesMs.size();
    result.timesMs.resize(earlier + slot.runningKey.pipelines.size(), 0.0);
    result.counters.resize(result.timesMs.size());
    std::vector<uint64_t> stamps(2 * recording.bands.size());
    if (recording.queries != VK_NULL_HANDLE) {
      device_.check(
          vkGetQueryPoolResults(device_.handle(), recording.queries, 0,
                                static_cast<uint32_t>(stamps.size()),
                                stamps.size() * sizeof(uint64_t), stamps.data(), sizeof(uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    }
    bool isTooLong = false;
    for (size_t i = 0; i < recording.bands.size(); ++i) {
      const Band& band = recording.bands[i];
      double timeMs = wallMs / double(recording.bands.size());
      if (!context_->hasTrueTimestamps)
        timeMs = slot.parts.timesMs()[i];
      else if (recording.queries != VK_NULL_HANDLE)
        timeMs = device_.timestampMs(stamps[2 * i], stamps[2 * i + 1]);
      result.timesMs[earlier + band.pass] += timeMs;
      isTooLong |= shortenBands(slot.runningKey, band, timeMs);
      GlslCounters counters;
      std::memcpy(&counters, slot.counters.mapped + i * sizeof counters, sizeof counters);
      PassCounters& sum = result.counters[earlier + band.pass];
      sum.raysPath += counters.raysPath;
      sum.raysShadow += counters.raysShadow;
      for (uint32_t k = 0; k < rl::RL_HEALTH_COUNT; ++k) sum.health[k] += counters.health[k];
    }
    if (isTooLong) {
      for (Slot& each : slots_) each.isStale = true;
    }
    return result;
  }

  void waitFor(Slot& slot) {
    const bool isCut = slot.parts.wait(
        device_,
        [&] {
          setWork(slot.parts.timesMs().size(), slot.parts.count(device_));
          return isStopped();
        },
        [this] { stopSlots(); });
    if (isCut || framesStopped()) throw FrameStopped();
  }

  void stopSlots() {
    const uint32_t stop = 1;
    for (Slot& slot : slots_) {
      for (size_t i = 0; slot.running != nullptr && i < slot.running->bands.size(); ++i)
        std::memcpy(slot.counters.mapped + i * sizeof(GlslCounters), &stop, sizeof stop);
    }
  }

  // Shortens the dispatches of a pass after one that took too long; returns true if it did.
  bool shortenBands(const RecordingKey& key, const Band& band, double timeMs) {
    if (timeMs <= kLongestBandMs || band.rows <= 1) return false;
    const uint32_t rows =
        std::max(1u, static_cast<uint32_t>(double(band.rows) * kLongestBandMs / (2.0 * timeMs)));
    const uint32_t pixels = rows * key.groups(band.pass, 0) * kGlslTile * kGlslTile;
    uint32_t& known = bandPixels_.emplace(key.pipelines[band.pass], pixels).first->second;
    known = std::min(known, pixels);
    return true;
  }

  std::shared_ptr<VulkanContext> context_;
  VulkanDevice& device_;
  VulkanMemory& memory_;
  std::shared_ptr<VulkanScene> scene_;
  std::string rayTracing_;
  SceneRays rays_ = SceneRays::bvh;
  GlslTrace trace_{};
  VulkanBuffers buffers_;
  VulkanRaster raster_;
  bool readsTexels_ = false;
  std::map<std::tuple<std::string, rl::FeatureMask, bool>, VkPipeline> pipelines_;
  std::map<VkPipeline, uint32_t> bandPixels_;  // pixels per band, if the first took too long
  std::array<Slot, kSlots> slots_;
  uint32_t next_ = 0;
  std::deque<Slot*> underWay_;
  std::deque<FrameResult> finished_;
};

}  // namespace

std::unique_ptr<Backend> makeVulkanBackend(const std::shared_ptr<const CompiledScene>& scene,
                                           const BackendOptions& options) {
  return std::make_unique<VulkanBackend>(scene, options);
}

}  // namespace restlab
