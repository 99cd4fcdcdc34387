// Choice of the kernels that the CPU runs.
#pragma once

#include <string>
#include <vector>

#include "core/dialect/features.h"

namespace restlab {

enum class KernelChoice {
  exact,    // compiled for exactly the features of the scene, when a session begins
  builtIn,  // the smallest of those that were compiled with the program
  general,  // with all features; on Vulkan all that glTF has, and closures and layers of the scene
};

// Features of general kernels: all that glTF can ask for. Of closures and layers they have those of
// the scene, as each lengthens every kernel.
rl::FeatureMask generalFeatures(rl::FeatureMask needed);

// Names of choices: "exact", "built-in", "general".
const std::vector<std::string>& kernelChoiceNames();
std::string kernelChoiceName(KernelChoice choice);
// `where` names the option or the setting in errors. Throws Error (badUsage) for an unknown name.
KernelChoice parseKernelChoice(const std::string& name, const std::string& where);
// RESTLAB_KERNELS, or exact.
KernelChoice defaultKernelChoice();
// Throws Error (badUsage) if RESTLAB_KERNELS is set and names none: the default is asked for before
// a program can report errors.
void checkDefaultKernelChoice();

}  // namespace restlab
