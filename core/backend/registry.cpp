// Registry of backends.
#include <fmt/format.h>

#include "core/backend/backend.h"
#include "core/base/error.h"

namespace restlab {

const std::vector<std::string>& backendNames() {
  static const std::vector<std::string> names = {"cpu", "vulkan"};
  return names;
}

std::vector<BackendInfo> backendRegistry() { return {cpuBackendInfo(), vulkanBackendInfo()}; }

std::unique_ptr<Backend> makeBackend(const std::string& name,
                                     std::shared_ptr<const CompiledScene> scene,
                                     const BackendOptions& options) {
  if (name == "cpu") return makeCpuBackend(std::move(scene), options);
  if (name == "vulkan") return makeVulkanBackend(std::move(scene), options);
  failUsage("unknown backend '" + name + "'" + didYouMean(name, backendNames()) +
            " (see: restlab list backends)");
}

}  // namespace restlab
