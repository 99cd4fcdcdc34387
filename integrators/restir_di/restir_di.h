// Types and parameters of the `restir_di` kernels.
#ifndef RL_RESTIR_DI_H
#define RL_RESTIR_DI_H

// Paths are reused up to the light at x1; light by an x2 is left to the path.
#define RL_DIRECT_ONLY 1
// sampleShade() ends the spatial pass.
#define RL_SAMPLE_SHADES 1
#include "core/path_sample/path_reuse.h"

#endif
