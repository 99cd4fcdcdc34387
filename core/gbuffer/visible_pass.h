// Buffers of the `visible` kernel.
#ifndef RL_VISIBLE_KERNEL_H
#define RL_VISIBLE_KERNEL_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct VisibleBuffers {
  QuadRef visible;
};

struct VisibleParams {
  uint padding;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS VisibleBuffers
#define RL_KERNEL_PARAMS VisibleParams

#endif
