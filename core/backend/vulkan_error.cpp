#include "core/backend/vulkan_error.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace restlab {

std::string vulkanResultName(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
      return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    default:
      return fmt::format("VkResult {}", static_cast<int>(result));
  }
}

void vulkanCheck(VkResult result, const std::string& device, const char* what) {
  if (result == VK_SUCCESS) return;
  if (result == VK_ERROR_DEVICE_LOST) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("{}: the device was lost during {} (driver crash, reset or watchdog); "
                            "try --backend cpu, or fewer pixels",
                            device, what));
  }
  throw Error(ExitCode::deviceUnavailable,
              fmt::format("{}: {} failed ({})", device, what, vulkanResultName(result)));
}

}  // namespace restlab
