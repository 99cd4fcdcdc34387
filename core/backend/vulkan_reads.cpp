#include "core/backend/vulkan_reads.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "core/base/error.h"

namespace restlab {

bool choosesTexels(const VulkanDevice& device, const GpuBuffer* arrays, size_t bytes) {
  const size_t texels = device.properties().limits.maxTexelBufferElements;
  const bool fits = arrays != nullptr && arrays->bytes / 4 <= texels && bytes / 16 <= texels &&
                    bytes <= device.largestAllocation();
  const bool indexes = device.info().indexesUniforms;
  const char* wanted = std::getenv("RESTLAB_VULKAN_READS");
  if (wanted == nullptr || *wanted == 0) return fits && indexes && device.info().kind == "cpu";
  if (std::string(wanted) != "texels" && std::string(wanted) != "addresses") {
    failUsage(fmt::format("RESTLAB_VULKAN_READS={}: texels or addresses would be right", wanted));
  }
  if (std::string(wanted) == "texels" && !indexes) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("RESTLAB_VULKAN_READS=texels: {} lacks "
                            "shaderUniformBufferArrayDynamicIndexing; addresses would be right",
                            device.name()));
  }
  if (std::string(wanted) == "texels" && !fits) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("RESTLAB_VULKAN_READS=texels: {} has views of {} texels, which the "
                            "scene or the {} MiB of the session exceed; addresses would be right",
                            device.name(), texels, bytes >> 20));
  }
  return std::string(wanted) == "texels";
}

}  // namespace restlab
