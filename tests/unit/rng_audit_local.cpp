#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME local
#define RL_KERNEL_HEADER "integrators/local/local.h"
#define RL_KERNEL_FILE "integrators/local/local.glsl"
#include "core/backend/cpu_kernel.inl"
