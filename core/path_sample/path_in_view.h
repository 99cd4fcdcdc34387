// State of a walk that finds the light in view.
#ifndef RL_PATH_IN_VIEW_H
#define RL_PATH_IN_VIEW_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

struct PathInView {
  vec3 radiance;
  vec3 unshadowed;  // of the light sample whose shadow ray is traced
};

RL_NAMESPACE_END

#endif
