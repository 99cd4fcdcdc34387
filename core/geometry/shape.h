// A surface that is not made of triangles, in a space of its own.
#ifndef RL_SHAPE_H
#define RL_SHAPE_H

#ifdef __cplusplus
#include "core/geometry/surface.h"
#endif

RL_NAMESPACE_BEGIN

// Sides reach beyond the rim of an end by this, in the shape's own space: rays at the rim would
// slip through between both by rounding.
const float RL_SHAPE_RIM = 2.0e-6f;

struct Shape {
  uint kind;       // RL_SHAPE_*
  uint firstWord;  // of its parameters, in SceneData::shapeWords (uvec4s)
};

// A point of a shape in its own space.
struct ShapePoint {
  vec3 posL;
  vec3 normalL;  // unit, to the outside
  vec3 dpdu;     // along the texture's u and v, of any length
  vec3 dpdv;
  vec2 uv;      // of textures
  vec3 extent;  // of each axis: bound of all coordinates in the computation of the point
};

// A point of a shape in world space: the triangle is its tangent plane.
struct ShapePointW {
  TriangleW tangents;  // p0: the point; e1 and e2: its derivatives along the texture's u and v
  vec3 normalW;        // unit, to the outside
  vec2 uv;
  float areaFactor;  // world area over area of the shape's own space
};

// A piece of a strand: the hull of two spheres. Normals of its side have the component `sine` along
// the axis, and `cosine` away from it.
struct CurvePiece {
  vec3 start;  // centre of the first sphere
  float startRadius;
  vec3 axis;  // unit, to the centre of the second sphere
  float axisLength;
  float endRadius;
  float sine;
  float cosine;
  uint first;  // of its words
};

RL_NAMESPACE_END

#endif
