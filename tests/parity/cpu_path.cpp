// The path kernel as C++, with the same traversal as its GLSL build.
#define RL_KERNEL_NAME parity_path
#define RL_KERNEL_MASKS(M) M(general, RL_FEATURE_ALL & ~(RL_FEATURE_CLOSURES | RL_FEATURE_SHAPES))
#define RL_KERNEL_HEADER "integrators/path/path.h"
#define RL_KERNEL_FILE "integrators/path/path.glsl"
#define RL_KERNEL_TRACE "tests/parity/brute_force.glsl"
#include "core/backend/cpu_kernel.inl"
