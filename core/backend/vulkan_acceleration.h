// Acceleration structure for ray queries: a bottom level for each geometry that instances use, a
// top level over the instances. The driver builds both on the device, from the scene's buffers
// there.
#pragma once

#include <memory>
#include <vector>

#include "core/backend/vulkan_memory.h"
#include "core/scene/compiled/bvh.h"

namespace restlab {

class VulkanAcceleration {
 public:
  // `scene`: the host's data; `placed`: the same with device addresses. Throws Error
  // (deviceUnavailable) if memory or the device's limits do not suffice.
  static std::unique_ptr<VulkanAcceleration> build(std::shared_ptr<VulkanMemory> memory,
                                                   const BvhInput& scene,
                                                   const rl::SceneData& placed);
  ~VulkanAcceleration();
  VulkanAcceleration(const VulkanAcceleration&) = delete;
  VulkanAcceleration& operator=(const VulkanAcceleration&) = delete;

  uint64_t address() const { return top_.address; }  // SceneData::accelerationStructure
  size_t bytes() const;

 private:
  struct Calls;
  struct Level {
    VkAccelerationStructureKHR handle = VK_NULL_HANDLE;
    GpuBuffer storage;
    uint64_t address = 0;
  };
  // Input of the build of one level; Vulkan's structs point into each other.
  struct Plan {
    VkAccelerationStructureGeometryKHR geometry{};
    VkAccelerationStructureBuildGeometryInfoKHR info{};
    VkAccelerationStructureBuildRangeInfoKHR range{};
    VkDeviceSize scratchBytes = 0;
    Level* level = nullptr;
  };

  explicit VulkanAcceleration(std::shared_ptr<VulkanMemory> memory);
  void buildBottom(const BvhInput& scene, const rl::SceneData& placed);
  void buildTop(const BvhInput& scene);
  void checkLimits(const BvhInput& scene) const;
  void create(Plan& plan);
  void run(std::vector<Plan*> plans);
  GpuBuffer allocateOnce(size_t bytes);

  std::shared_ptr<VulkanMemory> memory_;
  VulkanDevice& device_;
  std::unique_ptr<Calls> calls_;
  VkPhysicalDeviceAccelerationStructurePropertiesKHR limits_{};
  std::vector<Level> bottom_;  // per geometry; null if no instance uses it
  Level top_;
  std::vector<GpuBuffer> temporary_;  // freed when all is built
};

}  // namespace restlab
