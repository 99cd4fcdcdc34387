#include "core/backend/vulkan_scene.h"

#include <map>
#include <tuple>

#include "core/scene/compiled_scene.h"

namespace restlab {

std::shared_ptr<VulkanScene> VulkanScene::of(const std::shared_ptr<VulkanMemory>& memory,
                                             const std::shared_ptr<const CompiledScene>& scene) {
  static std::map<std::tuple<const void*, const void*, bool>, std::weak_ptr<VulkanScene>> known;
  scene->bindBvh();
  // A table that a session binds later is not in what was uploaded before.
  const bool hasAlbedo = scene->data().ggxAlbedo.data != nullptr;
  std::weak_ptr<VulkanScene>& entry = known[{memory.get(), scene.get(), hasAlbedo}];
  if (auto uploaded = entry.lock()) return uploaded;
  std::shared_ptr<VulkanScene> uploaded(new VulkanScene(memory, scene));
  entry = uploaded;
  return uploaded;
}

VulkanScene::VulkanScene(std::shared_ptr<VulkanMemory> memory,
                         std::shared_ptr<const CompiledScene> scene)
    : memory_(std::move(memory)), scene_(std::move(scene)) {
  const rl::SceneData placed = scene_->placedAt([&](const void* bytes, size_t count) {
    const GpuBuffer buffer = memory_->allocate(count, MemoryKind::device);
    buffers_.push_back(buffer);
    bytes_ += buffer.bytes;
    memory_->write(buffer, bytes, count);
    return buffer.address;
  });
  data_ = memory_->allocate(sizeof placed, MemoryKind::device);
  memory_->write(data_, &placed, sizeof placed);
}

VulkanScene::~VulkanScene() {
  for (const GpuBuffer& buffer : buffers_) memory_->free(buffer);
  memory_->free(data_);
}

}  // namespace restlab
