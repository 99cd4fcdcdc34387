#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every cache
#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME surflet_propose
#define RL_KERNEL_HEADER "core/caches/surflet/surflet.h"
#define RL_KERNEL_FILE "core/caches/surflet/propose.glsl"
#include "core/backend/cpu_kernel.inl"
