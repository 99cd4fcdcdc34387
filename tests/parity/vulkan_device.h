// Just enough Vulkan to run one compute kernel on buffers of device addresses, without a window.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace restlab::parity {

// Memory that host and device both see.
struct GpuBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
  uint64_t address = 0;
  size_t bytes = 0;
};

class VulkanDevice {
 public:
  // Every device with buffer device addresses, scalar block layout and coherent host memory; empty
  // where there is no Vulkan. Any other failure throws std::runtime_error.
  static std::vector<std::unique_ptr<VulkanDevice>> all();
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  const std::string& name() const { return name_; }

  // Lives as long as the device; zeroed.
  GpuBuffer& allocate(size_t bytes);
  // Allocates and fills.
  GpuBuffer& upload(const void* data, size_t bytes);

  // Runs a shader with specialization constant 0 = mask over groupsX x groupsY workgroups, and
  // waits.
  void run(const std::vector<uint32_t>& spirv, uint32_t mask, const void* push, uint32_t pushBytes,
           uint32_t groupsX, uint32_t groupsY);

 private:
  VulkanDevice() = default;
  void open(std::shared_ptr<VkInstance_T> instance, VkPhysicalDevice physical, uint32_t queueFamily,
            uint32_t memoryType);

  std::shared_ptr<VkInstance_T> instance_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  uint32_t memoryType_ = 0;
  std::string name_;
  std::vector<std::unique_ptr<GpuBuffer>> buffers_;
};

}  // namespace restlab::parity
