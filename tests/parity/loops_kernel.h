// Buffers of the kernel that turns in loops.
#ifndef RL_PARITY_LOOPS_H
#define RL_PARITY_LOOPS_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

struct LoopsBuffers {
  UintRef turned;  // by pixel: turns of the inner loop
  UintRef states;  // by pixel: what the turns made, so that no compiler leaves them out
};

struct LoopsParams {
  uint outer;
  uint inner;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS LoopsBuffers
#define RL_KERNEL_PARAMS LoopsParams

#endif
