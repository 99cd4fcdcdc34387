// A point of a mesh at which the parameters of a material are read.
#ifndef RL_MATERIAL_POINT_H
#define RL_MATERIAL_POINT_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct MaterialPoint {
  uint firstParameter;  // in SceneData::closureParameters
  Geometry geometry;
  uvec3 corners;  // of a triangle
  vec2 bary;      // on a triangle, or the texture coordinates of a shape
};

RL_NAMESPACE_END

#endif
