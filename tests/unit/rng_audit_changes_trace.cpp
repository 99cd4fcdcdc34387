#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME changes_trace
#define RL_KERNEL_HEADER "core/temporal_gradients/passes.h"
#define RL_KERNEL_FILE "core/temporal_gradients/trace.glsl"
#include "core/backend/cpu_kernel.inl"
