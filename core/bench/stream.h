// Buffers of the `stream` kernel, whose run time is memory traffic alone.
#ifndef RL_STREAM_KERNEL_H
#define RL_STREAM_KERNEL_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

const uint RL_STREAM_UVEC4S = 4u;  // that each pixel reads and writes

struct StreamBuffers {
  Uvec4Ref from;
  Uvec4Ref to;
};

struct StreamParams {
  uint padding;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS StreamBuffers
#define RL_KERNEL_PARAMS StreamParams

#endif
