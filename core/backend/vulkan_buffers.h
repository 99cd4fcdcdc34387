// The buffers of a session on a Vulkan device.
#pragma once

#include <memory>
#include <vector>

#include "core/backend/backend.h"
#include "core/backend/vulkan_memory.h"

namespace restlab {

// Buffers wait for place(), which may give all of them one piece of memory, so that kernels can
// read them through one view of texels. What comes later has its own.
class VulkanBuffers {
 public:
  explicit VulkanBuffers(std::shared_ptr<VulkanMemory> memory) : memory_(std::move(memory)) {}
  ~VulkanBuffers();
  VulkanBuffers(const VulkanBuffers&) = delete;
  VulkanBuffers& operator=(const VulkanBuffers&) = delete;

  // Zeroed memory; throws as VulkanMemory::allocate() does, for those that wait in place().
  BufferId allocate(size_t bytes);
  void place(bool together);
  bool isPlaced() const { return isPlaced_; }
  size_t bytes() const;

  const GpuBuffer& operator[](BufferId buffer) const { return buffers_[buffer]; }
  const GpuBuffer& together() const { return together_; }
  // Are all of them parts of that piece?
  bool areTogether(const std::vector<BufferId>& buffers) const;

 private:
  void placeAlone(GpuBuffer& buffer);

  std::shared_ptr<VulkanMemory> memory_;
  std::vector<GpuBuffer> buffers_;  // by BufferId; of those that wait, the bytes
  std::vector<GpuBuffer> alone_;    // those of them that are not parts of together_
  GpuBuffer together_;
  bool isPlaced_ = false;
};

}  // namespace restlab
