// Buffers, parameters and state of the `template` kernel.
#ifndef RL_TEMPLATE_H
#define RL_TEMPLATE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// Bound in this order by recordTemplate(). Read as gBuffers.
struct TemplateBuffers {
  Vec3Ref radiance;
};

// Filled by recordTemplate(). Read as gParams.
struct TemplateParams {
  float misExponent;
};

// State of a path while it is traced.
struct TemplateState {
  vec3 radiance;
  vec3 unseen;  // unshadowed contribution of the last light sample
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS TemplateBuffers
#define RL_KERNEL_PARAMS TemplateParams

#endif
