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
  vec2 shear;  // takes dir to that axis: the other two over it
};

// The next node or triangle.
struct BvhWords {
  uvec4 q0;
  uvec4 q1;
  uvec4 q2;
  uvec4 q3;
};

// Children of a node, x nearest; entry 3e38: the ray misses it.
struct BvhHits {
  uvec4 child;
  vec4 entry;
};

struct BvhStack {
  uint child[RL_BVH_STACK];
  float entry[RL_BVH_STACK];  // where the ray enters the child's bounds
};

RL_NAMESPACE_END

#endif
