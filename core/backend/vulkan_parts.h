// A frame's commands on their way to the device, in parts with a fence behind each.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/backend/vulkan_device.h"

namespace restlab {

// At most two parts are with the device. A driver in software runs a workgroup that has nothing to
// do in a good part of the time of one that has: it gets one band after the other, and no more of
// them once a frame is stopped. Other devices get all bands at once.
class VulkanParts {
 public:
  // Makes the fences; destroy() takes them back. Throws Error where the device fails.
  void create(VulkanDevice& device);
  void destroy(VulkanDevice& device);

  static bool givesBands(const VulkanDevice& device) { return device.info().kind == "cpu"; }

  // Submits the first parts. `commands` must live until wait() returns.
  void begin(VulkanDevice& device, const std::vector<VkCommandBuffer>& commands);
  // Submits the others as parts end, and returns at the end of the last one; true where the frame
  // was cut. isStopped: asked while waiting. stop: called to end what the device runs.
  bool wait(VulkanDevice& device, const std::function<bool()>& isStopped,
            const std::function<void()>& stop);

 private:
  void giveNext(VulkanDevice& device);

  std::array<VkFence, 2> fences_{};  // by turns
  const std::vector<VkCommandBuffer>* commands_ = nullptr;
  size_t given_ = 0;                       // of the commands
  size_t partsGiven_ = 0, partsDone_ = 0;  // each with a fence
};

}  // namespace restlab
