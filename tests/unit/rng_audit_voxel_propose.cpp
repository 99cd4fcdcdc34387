#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every cache
#include "tests/unit/rng_audit.h"

#define RL_KERNEL_NAME voxel_propose
#define RL_KERNEL_HEADER "core/caches/voxel/voxel.h"
#define RL_KERNEL_FILE "core/caches/voxel/propose.glsl"
#include "core/backend/cpu_kernel.inl"
