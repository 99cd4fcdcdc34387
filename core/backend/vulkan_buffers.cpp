#include "core/backend/vulkan_buffers.h"

#include <algorithm>

namespace restlab {

namespace {

constexpr size_t kAlignment = 256;  // alignment of parts; above any limit of a buffer or a view

}  // namespace

VulkanBuffers::~VulkanBuffers() {
  for (const GpuBuffer& buffer : alone_) memory_->free(buffer);
  memory_->free(together_);
}

BufferId VulkanBuffers::allocate(size_t bytes) {
  GpuBuffer buffer;
  buffer.bytes = (std::max<size_t>(bytes, 1) + kAlignment - 1) & ~(kAlignment - 1);
  if (isPlaced_) placeAlone(buffer);
  buffers_.push_back(buffer);
  return static_cast<BufferId>(buffers_.size() - 1);
}

void VulkanBuffers::placeAlone(GpuBuffer& buffer) {
  buffer = memory_->allocate(buffer.bytes, MemoryKind::device);
  alone_.push_back(buffer);
  memory_->clear(buffer);
}

void VulkanBuffers::place(bool together) {
  if (together) {
    together_ = memory_->allocate(bytes(), MemoryKind::device);
    memory_->clear(together_);
  }
  size_t offset = 0;
  for (GpuBuffer& buffer : buffers_) {
    if (!together) {
      placeAlone(buffer);
      continue;
    }
    buffer = VulkanMemory::part(together_, offset, buffer.bytes);
    offset += buffer.bytes;
  }
  isPlaced_ = true;
}

size_t VulkanBuffers::bytes() const {
  size_t total = 0;
  for (const GpuBuffer& buffer : buffers_) total += buffer.bytes;
  return total;
}

bool VulkanBuffers::areTogether(const std::vector<BufferId>& buffers) const {
  return std::all_of(buffers.begin(), buffers.end(), [this](BufferId b) {
    return b == kNoBuffer ||
           buffers_[b].address - together_.address < static_cast<uint64_t>(together_.bytes);
  });
}

}  // namespace restlab
