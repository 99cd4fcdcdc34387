// Objects that the sessions on one Vulkan device share.
#pragma once

#include <memory>

#include "core/backend/vulkan_kernels.h"

namespace restlab {

struct VulkanContext {
  std::shared_ptr<VulkanDevice> device;
  std::shared_ptr<VulkanMemory> memory;
  std::shared_ptr<VulkanKernels> kernels;

  // Returns the context of the device that the options name.
  static std::shared_ptr<VulkanContext> of(const VulkanOptions& options);
};

}  // namespace restlab
