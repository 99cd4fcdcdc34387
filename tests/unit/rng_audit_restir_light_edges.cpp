#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME restir_gi_light_edges
#define RL_KERNEL_HEADER "integrators/restir_gi/restir_gi.h"
#define RL_KERNEL_FILE "integrators/restir_gi/light_edges.glsl"
#include "core/backend/cpu_kernel.inl"
