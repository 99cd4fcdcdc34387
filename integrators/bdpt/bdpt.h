// Buffers, parameters and state of the kernels of `bdpt`.
#ifndef RL_BDPT_H
#define RL_BDPT_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// Strategies, by the number of vertices s from the light and t from the camera.
const uint RL_BDPT_EMISSION = 1u;  // s = 0: the camera's path meets a light
const uint RL_BDPT_LIGHT = 2u;     // s = 1, t > 1: a point of a light
const uint RL_BDPT_CONNECT = 4u;   // s > 1, t > 1
const uint RL_BDPT_SPLAT = 8u;     // t = 1, s > 1: a vertex of a light's path is seen
const uint RL_BDPT_ALL = 15u;

// Exponents of the heuristic of weights; 0: no weights, of a strategy alone.
const uint RL_BDPT_ALONE = 0u;
const uint RL_BDPT_BALANCE = 1u;
const uint RL_BDPT_POWER = 2u;

// Blocks of records of the light table. The records of one block are chosen alike.
const uint RL_BDPT_BLOCKS = 1024u;
// Floats of a block: weight of lamps and of suns, corners of the box around its instances, and the
// greatest radiance.
const uint RL_BDPT_BLOCK_FLOATS = 9u;
// Vertices that are looked at for the box, of all instances together and of one.
const uint RL_BDPT_BOX_VERTICES = 262144u;
const uint RL_BDPT_BOX_VERTICES_OF_ONE = 1024u;

// Words of the table: centre and radius of a ball around the scene, the greatest radiance,
// probability of the sky, number of records in a block; then the bounds of 32 random bits below
// which a block is chosen.
const uint RL_BDPT_TABLE_BRIGHTEST = 4u;
const uint RL_BDPT_TABLE_SKY = 5u;
const uint RL_BDPT_TABLE_PER_BLOCK = 6u;
const uint RL_BDPT_TABLE_BOUNDS = 8u;
const uint RL_BDPT_TABLE_WORDS = 1032u;

// Sums of splats are integers, so that their order does not matter: a channel is a number with
// digits of RL_BDPT_DIGIT_BITS, each in a word of its own. The last word counts splats: beyond
// RL_BDPT_MOST_SPLATS a word may have overflown.
const uint RL_BDPT_DIGITS = 8u;
const uint RL_BDPT_DIGIT_BITS = 12u;
const uint RL_BDPT_UNIT_BIT = 56u;  // bit of the number that stands for the greatest radiance
const uint RL_BDPT_SPLAT_WORDS = 25u;
const uint RL_BDPT_MOST_SPLATS = 0x100000u;

// Vertex numbers of the random numbers of a light's path: times the vertex of the camera's path
// that it is joined to.
const uint RL_BDPT_VERTEX_LIGHT = 2048u;

// Largest sum of weights that is kept: beyond, a strategy gets no share.
const float RL_BDPT_LARGEST = 1.0e30f;
// Cosine above which a draw in the other direction counts as the same.
const float RL_BDPT_SAME = 0.9999f;

struct BdptBuffers {
  FloatRef blocks;  // RL_BDPT_BLOCK_FLOATS a block
  UintRef table;    // RL_BDPT_TABLE_WORDS
  UintRef splats;   // RL_BDPT_SPLAT_WORDS a pixel
  Vec3Ref radiance;
};

struct BdptParams {
  uint exponent;          // RL_BDPT_POWER, ...
  uint strategies;        // RL_BDPT_EMISSION, ...
  uint causticsOfPoints;  // 1: light of points, spots and suns may meet a delta lobe first
};
RL_STATIC_ASSERT_SIZE(BdptParams, 12);

// Steps of the kernel, one a turn of its loop.
const uint RL_BDPT_TO_LIGHT = 0u;   // begin a light's path
const uint RL_BDPT_TO_JOIN = 1u;    // join the ends of both paths
const uint RL_BDPT_TO_MEDIA = 2u;   // find the bodies that a light is in
const uint RL_BDPT_TO_EMIT = 3u;    // leave the light
const uint RL_BDPT_TO_SUN = 4u;     // look whether light from infinity reaches the scene's ball
const uint RL_BDPT_TO_GO_ON = 5u;   // scatter at the end of the light's path
const uint RL_BDPT_TO_LOOK = 6u;    // scatter at the end of the camera's path
const uint RL_BDPT_TO_TRACE = 7u;   // trace the next ray of the light's path
const uint RL_BDPT_TO_FOLLOW = 8u;  // trace the next ray of the camera's path

// A point of a light, or a direction to one at infinity.
struct BdptStart {
  uint kind;    // RL_LIGHT_*
  uint record;  // in the light table
  vec3 point;   // world position; a unit direction to the light where it is at infinity
  float posError;
  vec3 normal;  // of an area: the front; of a spot: direction of travel; of a point: attenuation
  uint isTwoSided;
  vec2 cone;     // of a spot
  vec3 emitted;  // radiance; of points W/sr, of directional lights W/m^2
  float pdf;     // choice of the light included: per area, per solid angle of a sky, else discrete
  uint isFindable;  // 1: a ray may find the light
};

// A path from the camera or from a light, at its last vertex. Densities are per area, without that
// of Russian roulette; of a delta lobe its direction's counts as 1, the same from both ends.
struct BdptPath {
  Surface s;        // the last vertex, seen from where the path came
  vec3 throughput;  // of a light's path: without the cosine at which the last vertex was reached
  float density;    // of the last vertex
  float others;     // weight of the strategies that end this path at an earlier vertex but the
                    // last, over the square of the density of the way back
  float joins;      // 1: this vertex and the one before may be joined
  uint events;      // vertices that scatter, the last one included
  uint isAlive;
  Ray ray;            // the next one
  float pdfRay;       // of its direction; of a light at infinity: per area across it
  float pastDensity;  // of the vertex that the ray leaves
  float pastOthers;   // weight of the strategies that end this path at it or earlier
  float pastCosine;   // at which the ray leaves it
  float pastJoins;    // 1: it and the next one may be joined
  uint isParallel;    // 1: the ray comes from infinity, or from an orthographic camera
  float passedT;      // metres travelled before the ray's origin, since the last vertex
  uvec4 media;        // bodies that the ray travels in, or the last vertex was reached in
  uvec4 behind;       // bodies beyond the last vertex
  vec3 sigma;         // extinction on the way
  uint isScattered;   // 1: a medium has scattered the path since the last vertex
  uint stretches;     // in media that scatter
  Rng rng;
};

// The last vertices of two paths, to be joined.
struct BdptJoin {
  vec3 unshadowed;
  Ray ray;     // shadow ray
  uint rank;   // of the body that it travels in
  uint pixel;  // that sees the light's path
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS BdptBuffers
#define RL_KERNEL_PARAMS BdptParams

#endif
