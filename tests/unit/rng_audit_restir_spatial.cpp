#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME restir_gi_spatial
#define RL_KERNEL_HEADER "integrators/restir_gi/restir_gi.h"
#define RL_KERNEL_FILE "integrators/restir_gi/spatial.glsl"
#include "core/backend/cpu_kernel.inl"
