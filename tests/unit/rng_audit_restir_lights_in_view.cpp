#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME restir_gi_lights_in_view
#define RL_KERNEL_HEADER "integrators/restir_gi/restir_gi.h"
#define RL_KERNEL_FILE "core/reuse/lights_in_view.glsl"
#include "core/backend/cpu_kernel.inl"
