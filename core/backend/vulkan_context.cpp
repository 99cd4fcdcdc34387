#include "core/backend/vulkan_context.h"

#include <cstdlib>
#include <map>

namespace restlab {
namespace {

// Keeps the last context open: compiling its kernels again would cost the next session seconds.
std::shared_ptr<VulkanContext>& lastContext() {
  static std::shared_ptr<VulkanContext> last;
  return last;
}

// Closes the last context before the statics of a validation layer are gone, which were made when
// the device was opened. Later, any call into the layer crashes (version 1.4.309 does).
void closeAtExit() {
  static const int isRegistered = std::atexit([] { lastContext().reset(); });
  static_cast<void>(isRegistered);
}

}  // namespace

std::shared_ptr<VulkanContext> VulkanContext::of(const VulkanOptions& options) {
  static std::map<const VulkanDevice*, std::weak_ptr<VulkanContext>> known;
  std::shared_ptr<VulkanContext>& last = lastContext();
  std::shared_ptr<VulkanDevice> device = VulkanDevice::open(options);
  closeAtExit();
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
