// A compiled scene on a Vulkan device: the same SceneData with device addresses.
#pragma once

#include <cstdint>

#include "core/dialect/types.h"
#include "tests/parity/vulkan_device.h"

namespace restlab::parity {

// Copies every buffer that `scene` refers to (sizes are worked out from what refers to what) and a
// SceneData of device addresses; returns the address of the latter.
uint64_t uploadScene(VulkanDevice& device, const rl::SceneData& scene);

}  // namespace restlab::parity
