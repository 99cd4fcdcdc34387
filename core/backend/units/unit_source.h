// Source of a kernel unit: one kernel for one feature mask, as a C++ translation unit of its own.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "core/backend/dialect_sources.h"
#include "core/dialect/features.h"

namespace restlab {

struct KernelUnit {
  std::string kernel;        // as rl_add_kernel names it
  rl::FeatureMask mask = 0;  // RL_FEATURE_*
  auto operator<=>(const KernelUnit&) const = default;
};

// Name of the variable of a unit that holds its rl::CpuKernelEntry.
constexpr const char* kUnitEntry = "rlKernelUnitEntry";

// Translation unit that core/backend/cpu_kernel.inl makes of the kernel. `compilerVersion` is the
// __VERSION__ that it demands. Throws Error (badUsage) for an unknown kernel.
std::string unitText(const KernelUnit& unit, const std::string& compilerVersion);
// Files of the program that the unit includes, directly or not.
std::vector<DialectSource> unitSources(const KernelUnit& unit);

}  // namespace restlab
