// Values of the parameter `mis` and their flags for the reuse loop; mis_values_test.cpp compares
// them with the registry.
#pragma once

#include "core/resampling/reservoir.h"

namespace rl {

struct MisValue {
  const char* name;
  uint flags;
  bool isUnbiased;  // for any supports
};

inline constexpr MisValue kMisValues[] = {
    {"pairwise", RL_REUSE_PAIRWISE, true},
    {"defensive", RL_REUSE_PAIRWISE | RL_REUSE_DEFENSIVE, true},
    {"confidence", 0u, false},
};

}  // namespace rl
