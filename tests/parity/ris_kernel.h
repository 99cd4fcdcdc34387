// Buffers and parameters of the parity kernel: decisions and results of each thread.
#ifndef RL_PARITY_RIS_H
#define RL_PARITY_RIS_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

struct RisResult {
  uint picked;  // index of the selected candidate, RL_INVALID: none
  uint lobes;   // lobe of every candidate's draw, hashed together: all the discrete decisions
  float W;      // unbiased contribution weight
  float wSum;
  vec3 f;   // integrand of the selected candidate
  vec3 wi;  // direction of the selected candidate
};
RL_STATIC_ASSERT_SIZE(RisResult, 40);

RL_REF(RisResultRef, RisResult)

struct RisBuffers {
  RisResultRef results;
};

struct RisParams {
  uint candidates;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RisBuffers
#define RL_KERNEL_PARAMS RisParams

#endif
