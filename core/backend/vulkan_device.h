// Vulkan devices for compute: list, selection, and an opened device with its one queue.
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace restlab {

// Properties of a device that is not opened yet.
struct VulkanDeviceInfo {
  std::string name;    // the driver's name for the device
  std::string kind;    // "discrete", "integrated", "virtual", "cpu", "other"
  std::string driver;  // name and version, as the driver reports them
  std::string whyNot;  // missing requirements of this program; empty: the device can be used
  bool hasRayQuery = false;
  std::string whyNoRaster;       // missing for raster passes; empty: the device can run them
  bool indexesUniforms = false;  // shaderUniformBufferArrayDynamicIndexing
  uint64_t memoryBytes = 0;      // size of the largest device-local heap
};

// All devices in the order in which they are preferred: discrete, integrated, virtual, CPU; those
// that cannot be used last. Empty where there is no Vulkan driver.
std::vector<VulkanDeviceInfo> vulkanDeviceInfos();

struct VulkanOptions {
  std::string device;     // part of the device's name, in any case; "": first that can be used
  bool validate = false;  // with the validation layers, core and synchronisation
};

class VulkanDevice {
 public:
  // Opens the device that the options name; returns the same object for the same options. Throws
  // Error (deviceUnavailable) that says what is missing.
  static std::shared_ptr<VulkanDevice> open(const VulkanOptions& options);
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  const VulkanDeviceInfo& info() const { return info_; }
  const std::string& name() const { return info_.name; }
  VkDevice handle() const { return device_; }
  VkPhysicalDevice physical() const { return physical_; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }
  uint64_t largestAllocation() const { return largestAllocation_; }  // bytes
  bool hasTimestamps() const { return timestampBits_ != 0; }
  // Milliseconds between two timestamps.
  double timestampMs(uint64_t begin, uint64_t end) const;

  VkCommandBuffer newCommands();
  void freeCommands(VkCommandBuffer commands);
  // Submits; `fence` may be null.
  void submit(VkCommandBuffer commands, VkFence fence, const char* what);
  // Records, submits and waits.
  void runNow(const std::function<void(VkCommandBuffer)>& record, const char* what);
  void check(VkResult result, const char* what) const;
  // Throws std::runtime_error with the first message that the validation layers have had since the
  // last call.
  void throwValidationMessages();

  // RL_INVALID: there is none. `allowed`: a bit for each type.
  uint32_t memoryTypeOf(VkMemoryPropertyFlags wanted, uint32_t allowed = 0xffffffffu) const;

 private:
  VulkanDevice() = default;
  struct Instance;
  std::shared_ptr<Instance> instance_;
  VulkanDeviceInfo info_;
  VkPhysicalDeviceProperties properties_{};
  uint64_t largestAllocation_ = 0;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  uint32_t timestampBits_ = 0;

  friend std::vector<VulkanDeviceInfo> vulkanDeviceInfos();
};

}  // namespace restlab
