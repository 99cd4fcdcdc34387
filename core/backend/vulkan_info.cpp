// Vulkan's part of `restlab list backends`.
#include <fmt/format.h>

#include <vector>

#include "core/backend/backend.h"
#include "core/backend/vulkan_device.h"
#include "core/base/error.h"

namespace restlab {

BackendInfo vulkanBackendInfo() {
  BackendInfo info;
  info.name = "vulkan";
  std::vector<VulkanDeviceInfo> devices;
  try {
    devices = vulkanDeviceInfos();
  } catch (const Error& error) {
    info.whyNot = error.what();
  }
  for (const VulkanDeviceInfo& device : devices) {
    std::string line =
        fmt::format("{} ({}; {}; {} MiB; rays: bvh{})", device.name, device.kind, device.driver,
                    device.memoryBytes >> 20, device.hasRayQuery ? ", query" : "");
    if (!device.whyNot.empty()) line += " cannot be used: " + device.whyNot;
    info.devices.push_back(line);
  }
  info.available = !devices.empty() && devices.front().whyNot.empty();
  info.description = devices.empty() ? "compute shaders" : "compute shaders on " + devices[0].name;
  if (devices.empty() && info.whyNot.empty())
    info.whyNot = "no Vulkan device; the package mesa-vulkan-drivers has one in software";
  if (!devices.empty() && !devices.front().whyNot.empty()) info.whyNot = devices.front().whyNot;
  return info;
}

}  // namespace restlab
