// Buffers and parameters of the `guide` kernel.
#ifndef RL_GUIDE_H
#define RL_GUIDE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/gbuffer/guide_data.h"

RL_NAMESPACE_BEGIN

struct GuideBuffers {
  Uvec4Ref gbuffer;
  Uvec4Ref guide;
  Uvec4Ref guidePrevious;
  Uvec4Ref motion;
  Uvec4Ref firstHits;  // at the frame's film sample; read if RL_GUIDE_RASTER
};

struct GuideParams {
  uint flags;  // RL_GUIDE_*
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS GuideBuffers
#define RL_KERNEL_PARAMS GuideParams

#endif
