#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME radiance_trace
#define RL_KERNEL_HEADER "core/radiance_cache/cells.h"
#define RL_KERNEL_FILE "core/radiance_cache/trace.glsl"
#include "core/backend/cpu_kernel.inl"
