// The tally kernel as C++.
#define RL_KERNEL_NAME parity_tally
#define RL_KERNEL_MASKS(M) M(general, RL_FEATURE_ALL & ~(RL_FEATURE_CLOSURES | RL_FEATURE_SHAPES))
#define RL_KERNEL_HEADER "tests/parity/tally_kernel.h"
#define RL_KERNEL_FILE "tests/parity/tally_kernel.glsl"
#define RL_KERNEL_TRACE "tests/parity/brute_force.glsl"
#include "core/backend/cpu_kernel.inl"
