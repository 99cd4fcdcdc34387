// A compiled scene on a Vulkan device.
#pragma once

#include <memory>
#include <vector>

#include "core/backend/vulkan_acceleration.h"
#include "core/backend/vulkan_memory.h"

namespace restlab {

class CompiledScene;

// Structure that rays traverse: the project's own hierarchy, or the driver's.
enum class SceneRays { bvh, query };

class VulkanScene {
 public:
  // Returns the scene as it is bound now, with only what the rays need; sessions of one scene share
  // it.
  static std::shared_ptr<VulkanScene> of(const std::shared_ptr<VulkanMemory>& memory,
                                         const std::shared_ptr<const CompiledScene>& scene,
                                         SceneRays rays);
  ~VulkanScene();
  VulkanScene(const VulkanScene&) = delete;
  VulkanScene& operator=(const VulkanScene&) = delete;

  uint64_t address() const { return data_.address; }  // device address of the SceneData
  size_t bytes() const { return bytes_; }
  const CompiledScene& source() const { return *scene_; }
  const GpuBuffer& data() const { return data_; }  // the SceneData
  // Buffer of all arrays, without acceleration structures; null if there is more than one buffer.
  const GpuBuffer* arrays() const { return buffers_.size() == 1 ? buffers_.data() : nullptr; }

 private:
  VulkanScene(std::shared_ptr<VulkanMemory> memory, std::shared_ptr<const CompiledScene> scene)
      : memory_(std::move(memory)), scene_(std::move(scene)) {}
  void upload(SceneRays rays);

  std::shared_ptr<VulkanMemory> memory_;
  std::shared_ptr<const CompiledScene> scene_;
  std::vector<GpuBuffer> buffers_;
  std::unique_ptr<VulkanAcceleration> acceleration_;
  GpuBuffer data_;
  size_t bytes_ = 0;
};

}  // namespace restlab
