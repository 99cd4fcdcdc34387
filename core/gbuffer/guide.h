// Buffers and parameters of the `guide` kernel.
#ifndef RL_GUIDE_H
#define RL_GUIDE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/gbuffer/guide_data.h"

RL_NAMESPACE_BEGIN

struct GuideBuffers {
  QuadRef visible;
  QuadRef guide;
  QuadRef guideBefore;
  QuadRef motion;
};

struct GuideParams {
  uint flags;  // RL_GUIDE_*
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS GuideBuffers
#define RL_KERNEL_PARAMS GuideParams

#endif
