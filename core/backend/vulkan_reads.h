// How kernels on Vulkan read buffers.
#pragma once

#include <cstddef>

#include "core/backend/vulkan_memory.h"

namespace restlab {

// Returns whether kernels read the scene's arrays (null: they lie apart) and `bytes` of buffers by
// texels instead of addresses. Software drivers read four words through a texel in the time of one
// word by address, because reads by address loop over the lanes of a vector. RESTLAB_VULKAN_READS
// overrides the choice.
bool choosesTexels(const VulkanDevice& device, const GpuBuffer* arrays, size_t bytes);

}  // namespace restlab
