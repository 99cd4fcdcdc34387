// Reports results of Vulkan calls as Errors for the user.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace restlab {

// The name of a result, "VK_ERROR_DEVICE_LOST", or its number.
std::string vulkanResultName(VkResult result);

// Throws Error (deviceUnavailable) naming the device and what failed, unless the result is
// VK_SUCCESS.
void vulkanCheck(VkResult result, const std::string& device, const char* what);

}  // namespace restlab
