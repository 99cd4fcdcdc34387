// Buffers, parameters and state of the kernels of `local`.
#ifndef RL_LOCAL_H
#define RL_LOCAL_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/geometry/surface.h"
#include "core/raster/raster.h"

RL_NAMESPACE_BEGIN

// In the order of the parameters' choices.
const uint RL_LOCAL_CLOSURE = 0u;  // model
const uint RL_LOCAL_LAMBERT = 1u;
const uint RL_LOCAL_PHONG = 2u;
const uint RL_LOCAL_BLINN_PHONG = 3u;
const uint RL_LOCAL_PER_PIXEL = 0u;  // shading
const uint RL_LOCAL_GOURAUD = 1u;
const uint RL_LOCAL_FLAT = 2u;
const uint RL_LOCAL_SHADOW_RAYS = 1u;  // shadows; 0: none
const uint RL_LOCAL_SHADOW_MAP = 2u;
const uint RL_LOCAL_OCCLUSION_RAYS = 1u;  // occlusion; 0: none
const uint RL_LOCAL_OCCLUSION_SCREEN = 2u;
const uint RL_LOCAL_MIRROR = 1u;  // reflections; 0: none
const uint RL_LOCAL_GLOSSY = 2u;
const uint RL_LOCAL_MODULATE = 0u;  // texture_combine
const uint RL_LOCAL_REPLACE = 1u;
const uint RL_LOCAL_DECAL = 2u;
const uint RL_LOCAL_ADD = 3u;
// Most light samples, and most rays of occlusion, of a vertex.
const uint RL_LOCAL_MOST_RAYS = 64u;

// Shadow maps are squares of texels: distances (metres) from where a lamp shines from. A lamp has:
const uint RL_LOCAL_MAP_PARALLEL = 0u;  // one square across the scene
const uint RL_LOCAL_MAP_CONE = 1u;      // one square across a spot's cone
const uint RL_LOCAL_MAP_CUBE = 2u;      // six: +x, -x, +y, -y, +z, -z
const uint RL_LOCAL_MOST_SQUARES = 96u;
// Largest radius of the filter, in texels.
const uint RL_LOCAL_MOST_FILTER = 4u;
// Entries of the light table that are looked at for lamps with maps, in either of two ways.
const uint RL_LOCAL_MOST_RECORDS = 4096u;
// Cosine of half a spot's cone below which it has a cube.
const float RL_LOCAL_WIDEST_CONE = 0.25f;
// Largest tangent of the angle of incidence that the bias follows.
const float RL_LOCAL_STEEPEST = 32.0f;
// Surfaces of a lamp that a ray of its own map passes.
const uint RL_LOCAL_MOST_OWN = 16u;

// A uvec4 with the number of lamps, then RL_LOCAL_LAMP_UVEC4S for each.
const uint RL_LOCAL_LAMP_UVEC4S = 3u;

struct LocalBuffers {
  RasterBuffers raster;
  Vec3Ref radiance;
  Uvec4Ref lamps;     // that have maps
  FloatRef maps;      // squares, row by row
  Uvec4Ref surfaces;  // at pixel centres (core/gbuffer/gbuffer.h)
};

struct LocalParams {
  RasterParams raster;
  uint isRaster;     // 1: the rasteriser has found what the eye sees straight
  uint isVertexLit;  // 1: and the vertex stage has taken its light samples
  uint divisions;    // triangles are lit as if each were 4^n
  uint model;
  uint shading;
  uint shadows;    // 0: none
  uint occlusion;  // 0: none
  uint reflections;
  uint combine;
  uint lightSamples;  // 0: one of each lamp
  uint occlusionRays;
  uint hasDirect;         // 0: lamps give ambient light alone
  float occlusionRadius;  // metres; 0: without end
  float ambient;          // radiance from everywhere
  float ambientShare;     // of lamps, that comes from everywhere
  float highlight;        // of Phong's lobes
  float highlightPower;
  uint mapSquares;
  uint mapSize;   // texels along an edge
  float mapBias;  // in texels
  uint mapFilter;
  vec3 sceneLow;  // box around the scene
  vec3 sceneHigh;
};

// One surface that the eye sees, and the points where it is lit.
struct LocalVertex {
  uint events;     // scattering events before it
  uint points;     // 1, or the three corners of a triangle
  uint lights;     // light samples of a point
  uint occlusion;  // rays of occlusion of a point
};

// A part of a triangle.
struct LocalPart {
  vec2 corners[3];  // weights of the triangle's second and third corner
  vec3 shares;      // of the corners in a point of the part
};

// A lamp with shadow maps.
struct LocalLamp {
  vec3 origin;       // of distances; parallel: the middle of the square that they begin at
  uint key;          // instance of an area, record of any other light
  vec3 dir;          // unit; not of a cube
  uint shape;        // RL_LOCAL_MAP_*
  float halfWidth;   // of the square: metres (parallel), tangent (cone)
  float halfHeight;  // likewise
  uint firstSquare;
  uint isArea;
};

// A point in a shadow map.
struct LocalMapPlace {
  uint square;      // of the lamp's; RL_INVALID: outside of the map
  vec2 uv;          // -1 to 1
  float distance;   // metres from where the map is drawn from
  float texelSize;  // metres that a texel covers there, across the ray
  vec3 dirW;        // unit, to the lamp
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS LocalBuffers
#define RL_KERNEL_PARAMS LocalParams

#endif
