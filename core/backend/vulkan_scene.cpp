#include "core/backend/vulkan_scene.h"

#include <map>
#include <tuple>

#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

std::shared_ptr<VulkanScene> VulkanScene::of(const std::shared_ptr<VulkanMemory>& memory,
                                             const std::shared_ptr<const CompiledScene>& scene,
                                             SceneRays rays) {
  using Key = std::tuple<const void*, const void*, bool, bool, SceneRays>;
  static std::map<Key, std::weak_ptr<VulkanScene>> known;
  if (rays == SceneRays::bvh) scene->bindBvh();
  // The key includes what sessions bind: an upload from before lacks it.
  const bool hasAlbedo = scene->data().ggxAlbedo.data != nullptr;
  const bool hasLightTree = scene->data().lightTree.data != nullptr;
  std::weak_ptr<VulkanScene>& entry =
      known[{memory.get(), scene.get(), hasAlbedo, hasLightTree, rays}];
  if (auto uploaded = entry.lock()) return uploaded;
  std::shared_ptr<VulkanScene> uploaded(new VulkanScene(memory, scene));
  uploaded->upload(rays);
  entry = uploaded;
  return uploaded;
}

void VulkanScene::upload(SceneRays rays) {
  // All arrays lie in one buffer, which kernels may read through one view of texels.
  const auto roundUp = [](size_t count) { return (count + 255) & ~size_t{255}; };
  size_t total = 0;
  const auto measure = [&](const void*, size_t count) {
    total += roundUp(count);
    return uint64_t{0};
  };
  scene_->placedAt(measure, rays == SceneRays::bvh);
  const bool isWhole = total <= memory_->device().largestAllocation();
  if (isWhole) buffers_.push_back(memory_->allocate(total, MemoryKind::device));
  size_t offset = 0;
  const auto place = [&](const void* bytes, size_t count) {
    if (!isWhole) {
      buffers_.push_back(memory_->allocate(count, MemoryKind::device));
      offset = 0;
    }
    memory_->write(buffers_.back(), bytes, count, offset);
    const uint64_t address = buffers_.back().address + offset;
    offset += roundUp(count);
    return address;
  };
  rl::SceneData placed = scene_->placedAt(place, rays == SceneRays::bvh);
  for (const GpuBuffer& buffer : buffers_) bytes_ += buffer.bytes;
  if (rays == SceneRays::query) {
    acceleration_ = VulkanAcceleration::build(memory_, scene_->bvhInput(), placed);
    const uint64_t address = acceleration_->address();
    placed.accelerationStructure = {uint32_t(address), uint32_t(address >> 32)};
    bytes_ += acceleration_->bytes();
  }
  data_ = memory_->allocate(sizeof placed, MemoryKind::device);
  memory_->write(data_, &placed, sizeof placed);
}

VulkanScene::~VulkanScene() {
  for (const GpuBuffer& buffer : buffers_) memory_->free(buffer);
  memory_->free(data_);
}

}  // namespace restlab
