#include "core/backend/vulkan_context.h"

#include <map>

namespace restlab {

std::shared_ptr<VulkanContext> VulkanContext::of(const VulkanOptions& options) {
  // The last one stays open: compiling its kernels again would cost the next session seconds.
  static std::map<const VulkanDevice*, std::weak_ptr<VulkanContext>> known;
  static std::shared_ptr<VulkanContext> last;
  std::shared_ptr<VulkanDevice> device = VulkanDevice::open(options);
  std::weak_ptr<VulkanContext>& entry = known[device.get()];
  if (auto context = entry.lock()) {
    last = context;
    return context;
  }
  auto context = std::make_shared<VulkanContext>();
  context->device = device;
  context->memory = std::make_shared<VulkanMemory>(device);
  context->kernels =
      std::make_shared<VulkanKernels>(context->memory, device, KernelCache::defaultFolder());
  entry = context;
  last = context;
  return context;
}

}  // namespace restlab
