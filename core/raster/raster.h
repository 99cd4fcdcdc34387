// The raster pipeline: what its two stages read and write. A raster pass draws every triangle of
// the scene, and the box of every shape, and keeps the nearest surface at one point of each pixel.
//
// Both stages are functions of the dialect. On Vulkan they are the vertex and the fragment stage of
// a graphics pipeline, on the CPU kernels over corners and over fragments.
#ifndef RL_RASTER_H
#define RL_RASTER_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

// First member of the Buffers struct of raster kernels, with the name `raster`.
struct RasterBuffers {
  // A uvec4 a pixel: instance (RL_INVALID: nothing is there), primitive, and the weights of the
  // second and third corner.
  Uvec4Ref hits;
  Vec4Ref diffuse;    // light of the corners, interpolated; or null
  Vec4Ref highlight;  // likewise
  Uvec4Ref boxes;     // world box of each instance of a shape: two uvec4s, low and high corner
  // Exchanged by the two kernels and the rasteriser on the CPU; null on Vulkan.
  UintRef triangles;  // instance and primitive
  // Three a triangle: clip position. With light two vec4s more: diffuse, highlight, and behind them
  // the weights of the second and third corner of the scene's triangle.
  Vec4Ref corners;
  Uvec4Ref fragments;  // RL_FRAGMENT_UVEC4S each: hit; pixel, depth, whether it is kept
};

// First member of the Params struct of raster kernels, with the name `raster`.
struct RasterParams {
  uint isAtCentre;  // 1: pixels are looked at in their centre, 0: at the frame's film sample
  float nearest;    // metres from a perspective camera, below which surfaces are cut off
  float reach;      // metres from the origin, within which all surfaces lie
  uint hasLight;    // 1: corners have light
  uint divisions;   // each triangle is drawn as 4^n, and each of them is lit at its own corners
};

// Metres of RasterParams::nearest, over the scene's size. Clipping rounds to 1e-7 of a triangle.
const float RL_RASTER_NEAREST = 1.52587890625e-5f;

// A corner of what is drawn: of a triangle, of one of its parts, or of a shape's box.
struct RasterCorner {
  vec4 clip;       // homogeneous; y points down, the depth is 1 at the camera and 0 far away
  uint primitive;  // of the scene
  vec2 bary;       // weights of its second and third corner
  vec3 diffuse;
  vec3 highlight;
};

const uint RL_FRAGMENT_UVEC4S = 2u;

RL_NAMESPACE_END

#endif
