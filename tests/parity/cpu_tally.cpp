// The tally kernel as C++.
#define RL_KERNEL_NAME parity_tally
#define RL_KERNEL_MASK_NAME general
#define RL_KERNEL_MASK 16383u
#define RL_KERNEL_HEADER "tests/parity/tally_kernel.h"
#define RL_KERNEL_FILE "tests/parity/tally_kernel.glsl"
#define RL_KERNEL_TRACE "tests/parity/brute_force.glsl"
#include "core/backend/cpu_kernel.inl"
