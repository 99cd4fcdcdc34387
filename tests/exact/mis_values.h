// The values of `mis` and how the reuse loop is told each; mis_values_test.cpp holds them against
// the registry.
#pragma once

#include "core/resampling/reservoir.h"

namespace rl {

struct MisValue {
  const char* name;
  uint flags;
  bool isUnbiased;  // whatever the supports
};

inline constexpr MisValue kMisValues[] = {
    {"pairwise", RL_REUSE_PAIRWISE, true},
    {"defensive", RL_REUSE_PAIRWISE | RL_REUSE_DEFENSIVE, true},
    {"confidence", 0u, false},
};

}  // namespace rl
