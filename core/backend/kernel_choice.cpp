#include "core/backend/kernel_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/error.h"

namespace restlab {

rl::FeatureMask generalFeatures(rl::FeatureMask needed) {
  return (rl::RL_FEATURE_GLTF & ~rl::RL_FEATURE_LAYERS) | needed;
}

const std::vector<std::string>& kernelChoiceNames() {
  static const std::vector<std::string> names = {"exact", "built-in", "general"};
  return names;
}

std::string kernelChoiceName(KernelChoice choice) { return kernelChoiceNames()[size_t(choice)]; }

KernelChoice parseKernelChoice(const std::string& name, const std::string& where) {
  const std::vector<std::string>& names = kernelChoiceNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    failUsage(fmt::format("{} {}: {} would be right{}", where, name, fmt::join(names, ", "),
                          didYouMean(name, names)));
  }
  return static_cast<KernelChoice>(found - names.begin());
}

KernelChoice defaultKernelChoice() {
  const char* wanted = std::getenv("RESTLAB_KERNELS");
  const std::vector<std::string>& names = kernelChoiceNames();
  const auto found = std::find(names.begin(), names.end(), wanted == nullptr ? "" : wanted);
  return found == names.end() ? KernelChoice::exact
                              : static_cast<KernelChoice>(found - names.begin());
}

void checkDefaultKernelChoice() {
  const char* wanted = std::getenv("RESTLAB_KERNELS");
  if (wanted != nullptr && *wanted != 0) parseKernelChoice(wanted, "RESTLAB_KERNELS");
}

}  // namespace restlab
