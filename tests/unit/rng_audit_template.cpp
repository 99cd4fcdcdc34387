#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME template
#define RL_KERNEL_HEADER "integrators/template/template.h"
#define RL_KERNEL_FILE "integrators/template/template.glsl"
#include "core/backend/cpu_kernel.inl"
