#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME bdpt
#define RL_KERNEL_HEADER "integrators/bdpt/bdpt.h"
#define RL_KERNEL_FILE "integrators/bdpt/bdpt.glsl"
#include "core/backend/cpu_kernel.inl"
