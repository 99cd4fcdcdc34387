// Types and parameters of the `restir_gi` kernels.
#ifndef RL_RESTIR_GI_H
#define RL_RESTIR_GI_H

#include "core/path_sample/path_reuse.h"

#endif
