// The buffers of a session on a Vulkan device.
#pragma once

#include <memory>
#include <vector>

#include "core/backend/backend.h"
#include "core/backend/vulkan_memory.h"

namespace restlab {

// Buffers get memory in place(), which may put all of them into one piece, so that kernels can read
// them through one view of texels. Later buffers get memory of their own.
class VulkanBuffers {
 public:
  explicit VulkanBuffers(std::shared_ptr<VulkanMemory> memory) : memory_(std::move(memory)) {}
  ~VulkanBuffers();
  VulkanBuffers(const VulkanBuffers&) = delete;
  VulkanBuffers& operator=(const VulkanBuffers&) = delete;

  // Zeroed memory; throws as VulkanMemory::allocate() does. Before place() only the size is noted,
  // and place() throws instead.
  BufferId allocate(size_t bytes);
  void place(bool together);
  bool isPlaced() const { return isPlaced_; }
  size_t bytes() const;

  const GpuBuffer& operator[](BufferId buffer) const { return buffers_[buffer]; }
  const GpuBuffer& together() const { return together_; }
  // Returns whether all buffers are parts of together().
  bool areTogether(const std::vector<BufferId>& buffers) const;

 private:
  void placeAlone(GpuBuffer& buffer);

  std::shared_ptr<VulkanMemory> memory_;
  std::vector<GpuBuffer> buffers_;  // by BufferId; before place() only the bytes are set
  std::vector<GpuBuffer> alone_;    // buffers that are not parts of together_
  GpuBuffer together_;
  bool isPlaced_ = false;
};

}  // namespace restlab
