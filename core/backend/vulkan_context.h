// Objects that the sessions on one Vulkan device share.
#pragma once

#include <memory>

#include "core/backend/vulkan_kernels.h"

namespace restlab {

struct VulkanContext {
  std::shared_ptr<VulkanDevice> device;
  std::shared_ptr<VulkanMemory> memory;
  std::shared_ptr<VulkanKernels> kernels;
  // Timestamps of compute passes are right. A software driver that has drawn triangles writes them
  // when it draws next (Mesa 22.3): bands are timed by their fences then.
  bool hasTrueTimestamps = true;

  // Returns the context of the device that the options name.
  static std::shared_ptr<VulkanContext> of(const VulkanOptions& options);
};

}  // namespace restlab
