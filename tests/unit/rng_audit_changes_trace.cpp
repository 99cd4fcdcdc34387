#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME changes_trace
#define RL_KERNEL_HEADER "core/changes/passes.h"
#define RL_KERNEL_FILE "core/changes/trace.glsl"
#include "core/backend/cpu_kernel.inl"
