#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME path
#define RL_KERNEL_HEADER "integrators/path/path.h"
#define RL_KERNEL_FILE "integrators/path/path.glsl"
#include "core/backend/cpu_kernel.inl"
