#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME restir_di_initial
#define RL_KERNEL_HEADER "integrators/restir_di/restir_di.h"
#define RL_KERNEL_FILE "integrators/restir_di/initial.glsl"
#include "core/backend/cpu_kernel.inl"
