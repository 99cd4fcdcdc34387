// Buffers of a device, cut out of large blocks of its memory and known by their addresses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/vulkan_device.h"

namespace restlab {

enum class MemoryKind {
  device,    // fast for kernels
  upload,    // written by the host, visible to kernels
  readback,  // written by kernels, read by the host
};

// A part of a block. Copied freely; VulkanMemory::free() releases it.
struct GpuBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;  // buffer of the whole block
  VkDeviceSize offset = 0;
  size_t bytes = 0;
  uint64_t address = 0;
  std::byte* mapped = nullptr;  // not for MemoryKind::device
  uint32_t block = 0;
};

class VulkanMemory {
 public:
  explicit VulkanMemory(std::shared_ptr<VulkanDevice> device) : device_(std::move(device)) {}
  ~VulkanMemory();
  VulkanMemory(const VulkanMemory&) = delete;
  VulkanMemory& operator=(const VulkanMemory&) = delete;

  // Memory that is not cleared. Throws Error (deviceUnavailable) with the sizes if there is not
  // enough.
  GpuBuffer allocate(size_t bytes, MemoryKind kind);
  void free(const GpuBuffer& buffer);

  // Copy through memory that both sides see, and wait until the copy is done.
  void write(const GpuBuffer& to, const void* data, size_t bytes, size_t offset = 0);
  void read(const GpuBuffer& from, void* data, size_t bytes);
  void clear(const GpuBuffer& buffer);
  // Copies each first buffer to its second one, of the same size.
  void copy(const std::vector<std::pair<GpuBuffer, GpuBuffer>>& buffers);

  VulkanDevice& device() const { return *device_; }
  uint64_t bytesAllocated() const { return bytesAllocated_; }  // in whole blocks
  uint64_t bytesAvailable(MemoryKind kind) const;
  // A part of a buffer; not to be freed.
  static GpuBuffer part(const GpuBuffer& whole, size_t offset, size_t bytes);

 private:
  struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    uint64_t address = 0;
    std::byte* mapped = nullptr;
    MemoryKind kind = MemoryKind::device;
    size_t bytes = 0;
    std::map<size_t, size_t> holes;  // by offset: bytes
  };
  uint32_t newBlock(size_t bytes, MemoryKind kind);
  void release(Block& block);
  [[noreturn]] void failForMemory(size_t bytes, VkResult result) const;

  std::shared_ptr<VulkanDevice> device_;
  std::vector<Block> blocks_;  // released ones stay, empty
  uint64_t bytesAllocated_ = 0;
};

}  // namespace restlab
