#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME radiosity_direct
#define RL_KERNEL_HEADER "integrators/radiosity/radiosity.h"
#define RL_KERNEL_FILE "integrators/radiosity/direct.glsl"
#include "core/backend/cpu_kernel.inl"
