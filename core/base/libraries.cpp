#include "core/base/libraries.h"

#include <OpenEXR/OpenEXRConfig.h>
#include <fmt/format.h>
#include <glslang/build_info.h>
#include <tbb/version.h>
#include <vulkan/vulkan_core.h>

#include <glm/glm.hpp>

#include "core/backend/embree.h"

namespace restlab {

std::vector<std::pair<std::string, std::string>> libraryVersions() {
  return {
      {"Embree", fmt::format("{}.{}.{}", RTC_VERSION_MAJOR, RTC_VERSION_MINOR, RTC_VERSION_PATCH)},
      {"TBB", TBB_runtime_version()},
      {"OpenEXR", OPENEXR_VERSION_STRING},
      {"glslang", fmt::format("{}.{}.{}", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR,
                              GLSLANG_VERSION_PATCH)},
      {"Vulkan headers", fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(VK_HEADER_VERSION_COMPLETE),
                                     VK_API_VERSION_MINOR(VK_HEADER_VERSION_COMPLETE),
                                     VK_API_VERSION_PATCH(VK_HEADER_VERSION_COMPLETE))},
      {"GLM", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)}};
}

}  // namespace restlab
