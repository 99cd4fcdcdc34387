// Buffers of the kernel that tests atomic words: every pixel belongs to one of a few bins.
#ifndef RL_PARITY_TALLY_H
#define RL_PARITY_TALLY_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

struct TallyBuffers {
  UintRef counts;    // by bin: number of its pixels
  UintRef greatest;  // by bin: greatest hash of its pixels
  UintRef claims;    // by bin: RL_INVALID at first, then one of its pixels
  UintRef claimed;   // by pixel: 1 if its claim came first
};

struct TallyParams {
  uint bins;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS TallyBuffers
#define RL_KERNEL_PARAMS TallyParams

#endif
