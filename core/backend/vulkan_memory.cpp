#include "core/backend/vulkan_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/backend/vulkan_error.h"
#include "core/base/error.h"
#include "core/base/memory.h"

namespace restlab {

namespace {

constexpr size_t kBlockBytes = size_t{64} << 20;
constexpr size_t kStagingBytes = size_t{16} << 20;
constexpr size_t kPoolAlignment = 256;  // buffer alignment; above any limit of a storage buffer

size_t roundUp(size_t bytes) {
  return (std::max<size_t>(bytes, 1) + kPoolAlignment - 1) & ~(kPoolAlignment - 1);
}

VkMemoryPropertyFlags propertiesOf(MemoryKind kind) {
  if (kind == MemoryKind::device) return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  return VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}

}  // namespace

VulkanMemory::~VulkanMemory() {
  for (Block& block : blocks_) release(block);
}

void VulkanMemory::release(Block& block) {
  if (block.buffer != VK_NULL_HANDLE) vkDestroyBuffer(device_->handle(), block.buffer, nullptr);
  if (block.memory != VK_NULL_HANDLE) {
    vkFreeMemory(device_->handle(), block.memory, nullptr);
    bytesAllocated_ -= block.bytes;
  }
  block = Block();
}

// Software drivers take the host's memory, whatever heap size they report, until the operating
// system ends the program. Return what the host has, so that larger requests are refused before.
uint64_t VulkanMemory::bytesAvailable(MemoryKind kind) const {
  const uint64_t onHost = availableMemory().value_or(~uint64_t{0});
  if (kind != MemoryKind::device || device_->info().kind == "cpu") return onHost;
  return device_->info().memoryBytes - std::min(bytesAllocated_, device_->info().memoryBytes);
}

void VulkanMemory::failForMemory(size_t bytes, VkResult result) const {
  throw Error(
      ExitCode::deviceUnavailable,
      fmt::format("{}: out of memory: {} MiB more are needed, {} MiB are in use, {} MiB are "
                  "available ({}); choose a smaller resolution or scene",
                  device_->name(), (bytes + (1u << 20) - 1) >> 20, bytesAllocated_ >> 20,
                  bytesAvailable(MemoryKind::device) >> 20, vulkanResultName(result)));
}

uint32_t VulkanMemory::newBlock(size_t bytes, MemoryKind kind) {
  if (bytes > bytesAvailable(kind)) failForMemory(bytes, VK_ERROR_OUT_OF_DEVICE_MEMORY);
  Block block;
  block.kind = kind;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (device_->info().hasRayQuery)
    info.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                  VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
  VkDevice device = device_->handle();
  VkResult result = vkCreateBuffer(device, &info, nullptr, &block.buffer);
  if (result != VK_SUCCESS) failForMemory(bytes, result);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, block.buffer, &needs);
  uint32_t type = device_->memoryTypeOf(propertiesOf(kind));
  if (type == 0xffffffffu || (needs.memoryTypeBits & (1u << type)) == 0) {
    release(block);
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("{}: no {} memory for buffers", device_->name(),
                            kind == MemoryKind::device ? "device-local" : "host-coherent"));
  }
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.pNext = &flags;
  allocation.allocationSize = needs.size;
  allocation.memoryTypeIndex = type;
  result = vkAllocateMemory(device, &allocation, nullptr, &block.memory);
  if (result != VK_SUCCESS) {
    release(block);
    failForMemory(bytes, result);
  }
  block.bytes = bytes;
  bytesAllocated_ += bytes;
  device_->check(vkBindBufferMemory(device, block.buffer, block.memory, 0), "vkBindBufferMemory");
  if (kind != MemoryKind::device) {
    void* mapped = nullptr;
    device_->check(vkMapMemory(device, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    block.mapped = static_cast<std::byte*>(mapped);
  }
  VkBufferDeviceAddressInfo address{};
  address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  address.buffer = block.buffer;
  block.address = vkGetBufferDeviceAddress(device, &address);
  block.holes[0] = bytes;
  for (uint32_t i = 0; i < blocks_.size(); ++i) {
    if (blocks_[i].buffer != VK_NULL_HANDLE) continue;
    blocks_[i] = std::move(block);
    return i;
  }
  blocks_.push_back(std::move(block));
  return static_cast<uint32_t>(blocks_.size() - 1);
}

GpuBuffer VulkanMemory::allocate(size_t bytes, MemoryKind kind) {
  const size_t size = roundUp(bytes);
  uint32_t index = 0xffffffffu;
  std::map<size_t, size_t>::iterator hole;
  for (uint32_t i = 0; i < blocks_.size() && index == 0xffffffffu; ++i) {
    if (blocks_[i].buffer == VK_NULL_HANDLE || blocks_[i].kind != kind) continue;
    std::map<size_t, size_t>& holes = blocks_[i].holes;
    hole =
        std::find_if(holes.begin(), holes.end(), [&](const auto& h) { return h.second >= size; });
    if (hole != holes.end()) index = i;
  }
  if (index == 0xffffffffu) {
    // A large buffer gets a block of its own size, and nothing is wasted behind it.
    index = newBlock(size > kBlockBytes / 2 ? size : kBlockBytes, kind);
    hole = blocks_[index].holes.begin();
  }
  Block& block = blocks_[index];
  GpuBuffer buffer;
  buffer.buffer = block.buffer;
  buffer.offset = hole->first;
  buffer.bytes = size;
  buffer.address = block.address + hole->first;
  buffer.mapped = block.mapped != nullptr ? block.mapped + hole->first : nullptr;
  buffer.block = index;
  const size_t rest = hole->second - size;
  block.holes.erase(hole);
  if (rest > 0) block.holes[buffer.offset + size] = rest;
  return buffer;
}

void VulkanMemory::free(const GpuBuffer& buffer) {
  if (buffer.buffer == VK_NULL_HANDLE) return;
  Block& block = blocks_[buffer.block];
  auto hole = block.holes.emplace(buffer.offset, buffer.bytes).first;
  const auto next = std::next(hole);
  if (next != block.holes.end() && hole->first + hole->second == next->first) {
    hole->second += next->second;
    block.holes.erase(next);
  }
  if (hole != block.holes.begin()) {
    const auto previous = std::prev(hole);
    if (previous->first + previous->second == hole->first) {
      previous->second += hole->second;
      block.holes.erase(hole);
    }
  }
  if (block.holes.size() == 1 && block.holes.begin()->second == block.bytes) release(block);
}

GpuBuffer VulkanMemory::part(const GpuBuffer& whole, size_t offset, size_t bytes) {
  GpuBuffer buffer = whole;
  buffer.offset += offset;
  buffer.address += offset;
  if (buffer.mapped != nullptr) buffer.mapped += offset;
  buffer.bytes = bytes;
  return buffer;
}

void VulkanMemory::write(const GpuBuffer& to, const void* data, size_t bytes, size_t offset) {
  if (bytes == 0) return;
  if (to.mapped != nullptr) {
    std::memcpy(to.mapped + offset, data, bytes);
    return;
  }
  const GpuBuffer staging = allocate(std::min(bytes, kStagingBytes), MemoryKind::upload);
  for (size_t done = 0; done < bytes; done += kStagingBytes) {
    const size_t part = std::min(kStagingBytes, bytes - done);
    std::memcpy(staging.mapped, static_cast<const std::byte*>(data) + done, part);
    device_->runNow(
        [&](VkCommandBuffer commands) {
          const VkBufferCopy region{staging.offset, to.offset + offset + done, part};
          vkCmdCopyBuffer(commands, staging.buffer, to.buffer, 1, &region);
        },
        "copying to the device");
  }
  free(staging);
}

void VulkanMemory::read(const GpuBuffer& from, void* data, size_t bytes) {
  if (bytes == 0) return;
  if (from.mapped != nullptr) {
    std::memcpy(data, from.mapped, bytes);
    return;
  }
  const GpuBuffer staging = allocate(std::min(bytes, kStagingBytes), MemoryKind::readback);
  for (size_t done = 0; done < bytes; done += kStagingBytes) {
    const size_t part = std::min(kStagingBytes, bytes - done);
    device_->runNow(
        [&](VkCommandBuffer commands) {
          const VkBufferCopy region{from.offset + done, staging.offset, part};
          vkCmdCopyBuffer(commands, from.buffer, staging.buffer, 1, &region);
          VkMemoryBarrier barrier{};
          barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
          barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
          barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
          vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                               0, 1, &barrier, 0, nullptr, 0, nullptr);
        },
        "copying from the device");
    std::memcpy(static_cast<std::byte*>(data) + done, staging.mapped, part);
  }
  free(staging);
}

void VulkanMemory::clear(const GpuBuffer& buffer) {
  device_->runNow(
      [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer.buffer, buffer.offset, buffer.bytes, 0);
      },
      "clearing a buffer");
}

void VulkanMemory::copy(const std::vector<std::pair<GpuBuffer, GpuBuffer>>& buffers) {
  device_->runNow(
      [&](VkCommandBuffer commands) {
        for (const auto& [from, to] : buffers) {
          const VkBufferCopy region{from.offset, to.offset, from.bytes};
          vkCmdCopyBuffer(commands, from.buffer, to.buffer, 1, &region);
        }
      },
      "copying buffers");
}

}  // namespace restlab
