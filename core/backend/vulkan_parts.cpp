#include "core/backend/vulkan_parts.h"

namespace restlab {

void VulkanParts::create(VulkanDevice& device) {
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  for (VkFence& fence : fences_)
    device.check(vkCreateFence(device.handle(), &info, nullptr, &fence), "vkCreateFence");
}

void VulkanParts::destroy(VulkanDevice& device) {
  for (const VkFence fence : fences_)
    if (fence != VK_NULL_HANDLE) vkDestroyFence(device.handle(), fence, nullptr);
}

void VulkanParts::begin(VulkanDevice& device, const std::vector<VkCommandBuffer>& commands) {
  commands_ = &commands;
  given_ = partsGiven_ = partsDone_ = 0;
  partBegan_ = std::chrono::steady_clock::now();
  timesMs_.clear();
  for (size_t part = 0; part < fences_.size(); ++part) giveNext(device);
}

void VulkanParts::giveNext(VulkanDevice& device) {
  if (given_ == commands_->size()) return;
  const VkFence fence = fences_[partsGiven_++ % fences_.size()];
  device.check(vkResetFences(device.handle(), 1, &fence), "vkResetFences");
  const size_t end = givesBands(device) ? given_ + 1 : commands_->size();
  for (; given_ < end; ++given_) {
    const bool isLast = given_ + 1 == end;
    device.submit((*commands_)[given_], isLast ? fence : VK_NULL_HANDLE, "a frame");
  }
}

bool VulkanParts::wait(VulkanDevice& device, const std::function<bool()>& isStopped,
                       const std::function<void()>& stop) {
  constexpr uint64_t kNanoseconds = 50'000'000;
  bool isCut = false;
  while (partsDone_ < partsGiven_) {
    const VkFence fence = fences_[partsDone_++ % fences_.size()];
    VkResult result = VK_TIMEOUT;
    while (result == VK_TIMEOUT) {
      result = vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, kNanoseconds);
      if (result != VK_TIMEOUT || !isStopped()) continue;
      stop();
      isCut = true;
    }
    device.check(result, "a frame");
    const auto now = std::chrono::steady_clock::now();
    timesMs_.push_back(std::chrono::duration<double, std::milli>(now - partBegan_).count());
    partBegan_ = now;
    isCut = isCut || (given_ < commands_->size() && isStopped());
    if (!isCut) giveNext(device);
  }
  return isCut;
}

}  // namespace restlab
