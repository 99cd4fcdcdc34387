// Submission of a frame's commands in parts, with a fence behind each.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/backend/vulkan_device.h"

namespace restlab {

// At most two parts are with the device. On a software driver a workgroup with nothing to do takes
// a good part of the time of one that works: the driver gets one band after the other, and no more
// bands once a frame is stopped. Other devices get all bands at once.
class VulkanParts {
 public:
  // Creates the fences; destroy() frees them. Throws Error if the device fails.
  void create(VulkanDevice& device);
  void destroy(VulkanDevice& device);

  static bool givesBands(const VulkanDevice& device) { return device.info().kind == "cpu"; }

  // Submits the first parts. `commands` must live until wait() returns.
  void begin(VulkanDevice& device, const std::vector<VkCommandBuffer>& commands);
  // Submits further parts as earlier ones end, and returns at the end of the last one; true if the
  // frame was cut. isStopped: polled while waiting. stop: called to end the work on the device.
  bool wait(VulkanDevice& device, const std::function<bool()>& isStopped,
            const std::function<void()>& stop);

  // Parts of the frame: as many as timesMs() has in the end, unless the frame is cut.
  size_t count(const VulkanDevice& device) const {
    return givesBands(device) ? commands_->size() : 1;
  }

  // Milliseconds that each part took, once wait() has returned: from the end of the one before, or
  // from begin(), to the time at which the host saw its end.
  const std::vector<double>& timesMs() const { return timesMs_; }

 private:
  void giveNext(VulkanDevice& device);

  std::array<VkFence, 2> fences_{};  // used in turn
  const std::vector<VkCommandBuffer>* commands_ = nullptr;
  size_t given_ = 0;                       // commands that were submitted
  size_t partsGiven_ = 0, partsDone_ = 0;  // each part has a fence
  std::chrono::steady_clock::time_point partBegan_;
  std::vector<double> timesMs_;
};

}  // namespace restlab
