// Buffers, parameters and state of the kernels that find changes.
#ifndef RL_CHANGES_PASSES_H
#define RL_CHANGES_PASSES_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/temporal_gradients/changes.h"
#include "core/transport/light_sum.h"

RL_NAMESPACE_BEGIN

struct ChangePassParams {
  ChangeParams changes;
};

struct ChangeWalk {
  LightSum sum;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS ChangeBuffers
#define RL_KERNEL_PARAMS ChangePassParams

#endif
