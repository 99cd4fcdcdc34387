// Buffers, parameters and records of the kernels of `radiosity`.
//
// Unknowns are irradiances E (W/m^2) of the vertices of a mesh of elements, one for each side of a
// surface: unknown 2 v is the front of vertex v, 2 v + 1 its back. A side of an element has the
// number 2 e or 2 e + 1 in the same way.
#ifndef RL_RADIOSITY_H
#define RL_RADIOSITY_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/geometry/surface.h"

RL_NAMESPACE_BEGIN

// In the order of the parameters' choices.
const uint RL_RADIOSITY_SOUTHWELL = 2u;  // solver; 0: Jacobi, 1: Gauss-Seidel
const uint RL_RADIOSITY_POLYGON = 1u;    // factors; 0: by rays

const uint RL_RADIOSITY_VERTEX_UVEC4S = 2u;   // the SurfaceId; its area (m^2)
const uint RL_RADIOSITY_ELEMENT_UVEC4S = 2u;  // vertices and area; place in a triangle
// Rays of an entry of a pass: some devices end loops that take too many turns.
const uint RL_RADIOSITY_CHUNK = 16u;
// Unknowns, or sides of elements, that one entry of a sum looks at.
const uint RL_RADIOSITY_GROUP = 256u;
// Points of an element that a ray looks for.
const uint RL_RADIOSITY_POINTS = 4u;

// Words of RadiosityBuffers::state.
const uint RL_RADIOSITY_ITERATIONS = 0u;  // done
const uint RL_RADIOSITY_SET = 1u;         // of unknowns that is next
const uint RL_RADIOSITY_IS_SOLVED = 2u;
const uint RL_RADIOSITY_CHANGE = 3u;  // a float: sum over the sets of this iteration
const uint RL_RADIOSITY_SCALE = 4u;   // a float: the same sum of the light of the sources
const uint RL_RADIOSITY_STATE_WORDS = 8u;

struct RadiosityBuffers {
  UintRef instances;    // first entry of `triangles` of an instance
  UintRef triangles;    // first element, divisions of an edge
  Uvec4Ref elements;    // RL_RADIOSITY_ELEMENT_UVEC4S each
  Uvec4Ref vertices;    // RL_RADIOSITY_VERTEX_UVEC4S each
  Vec3Ref albedo;       // of an element
  UintRef hits;         // of a ray of an unknown: the side of an element; place in it
  FloatRef factors;     // of an unknown and an element
  Vec3Ref directParts;  // of an unknown and a chunk
  Vec3Ref source;       // irradiance of an unknown by lights, W/m^2
  Vec3Ref irradiance;   // of an unknown
  Vec3Ref pending;      // its next value
  FloatRef change;      // of an unknown by the last iteration
  Vec3Ref shot;         // irradiance of a side of an element whose reflection was sent
  Uvec4Ref chosen;      // a side of an element, and what it sends
  Vec2Ref parts;        // sums of a group
  UintRef state;
  FloatRef residuals;  // by iteration
  Vec3Ref radiance;
  UintRef seen;  // of a pixel: 1 + the side of an element; 0: none
};

struct RadiosityParams {
  uint unknowns;
  uint elements;
  uint raysPerSide;   // of the square of strata of an unknown
  uint lightChunks;   // of an unknown
  uint usesPolygons;  // 1: factors by Lambert's formula
  uint solver;
  uint sets;    // of unknowns, one after another in an iteration
  uint groups;  // of sums
  uint shots;   // sides of elements that an iteration of Southwell sends
  uint iterations;
  float tolerance;
};

// A place in the mesh.
struct ElementPlace {
  uint element;
  vec3 weights;  // of its three vertices
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RadiosityBuffers
#define RL_KERNEL_PARAMS RadiosityParams

#endif
