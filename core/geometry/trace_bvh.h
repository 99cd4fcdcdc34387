// State of a traversal of the project's own hierarchy.
#ifndef RL_TRACE_BVH_H
#define RL_TRACE_BVH_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

// A ray in the space of the level that is traversed.
struct BvhRay {
  vec3 origin;
  vec3 dir;
  vec3 inverseDir;
  uint axis;   // the largest component of dir
  vec2 shear;  // the other two components of dir over the one of `axis`
};

// Record of a node or a triangle.
struct BvhWords {
  uvec4 q0;
  uvec4 q1;
  uvec4 q2;
  uvec4 q3;
};

// Children of a node, the nearest in x; entry 3e38: the ray misses the child.
struct BvhHits {
  uvec4 child;
  vec4 entry;
};

struct BvhStack {
  uint child[RL_BVH_STACK];
  float entry[RL_BVH_STACK];  // ray parameter at which the ray enters the child's bounds
};

RL_NAMESPACE_END

#endif
