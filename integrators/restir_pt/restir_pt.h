// Types and parameters of the `restir_pt` kernels.
#ifndef RL_RESTIR_PT_H
#define RL_RESTIR_PT_H

// Shifts replay the path up to the vertices that reconnect.
#define RL_PATH_REPLAYS 1
#include "core/path_sample/path_reuse.h"

#endif
