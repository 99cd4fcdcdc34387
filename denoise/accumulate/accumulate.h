// Buffers and parameters of the `accumulate` kernel.
#ifndef RL_ACCUMULATE_H
#define RL_ACCUMULATE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/temporal_gradients/changes.h"
#include "denoise/common/average.h"

RL_NAMESPACE_BEGIN

const uint RL_ACCUMULATE_BILINEAR = 1u;  // flag: the history is read between pixels

struct AccumulateBuffers {
  Vec3Ref radiance;  // radiance of this frame
  Uvec4Ref gbuffer;  // core/gbuffer/gbuffer.h
  Uvec4Ref gbufferPrevious;
  UintRef changes;      // core/temporal_gradients
  Vec3Ref accumulated;  // the output
  Uvec4Ref history;     // Average
  Uvec4Ref historyBefore;
};

struct AccumulateParams {
  float cap;  // frames
  SimilarityThresholds similarity;
  uint flags;  // RL_ACCUMULATE_*
  ChangeParams changes;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS AccumulateBuffers
#define RL_KERNEL_PARAMS AccumulateParams

#endif
