// Programs that compute a function of a place: the surface is where it is 0, the inside where it is
// below. Registers 0 to 2 hold the place; the last instruction leaves the value.
#ifndef RL_FIELD_H
#define RL_FIELD_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

// An instruction is a uvec4: kind | to << 8 | a << 16 | b << 24, then constants k, m, n.
const uint RL_FIELD_LINEAR = 0u;      // k a + m
const uint RL_FIELD_PLANE = 1u;       // k x + m y + n z
const uint RL_FIELD_ADD = 2u;         // a + b
const uint RL_FIELD_SUBTRACT = 3u;    // a - b
const uint RL_FIELD_MULTIPLY = 4u;    // a b
const uint RL_FIELD_RECIPROCAL = 5u;  // 1 / a
const uint RL_FIELD_MIN = 6u;
const uint RL_FIELD_MAX = 7u;
const uint RL_FIELD_SQUARE = 8u;
const uint RL_FIELD_SQRT = 9u;  // of a number below 0: 0
const uint RL_FIELD_ABS = 10u;
const uint RL_FIELD_SIN = 11u;  // radians
const uint RL_FIELD_COS = 12u;
const uint RL_FIELD_EXP = 13u;
const uint RL_FIELD_FOLD = 14u;    // distance of a to the nearest even number
const uint RL_FIELD_LENGTH = 15u;  // of the vector (a, b)
// Samples at the place (a, b, register k), m uvec4s behind the first instruction.
const uint RL_FIELD_GRID = 16u;
const uint RL_FIELD_KINDS = 17u;

const uint RL_FIELD_REGISTERS = 24u;
// The first words of a shape: box (x, y, z) and number of instructions, box (x, y, z) and whether
// the surface is closed.
const uint RL_FIELD_HEADER = 2u;

// Segments of a ray that are looked at. A ray that needs more takes the rest as one, and is counted
// (RL_HEALTH_SEGMENTS).
const uint RL_FIELD_SEGMENTS = 384u;
// Largest bound of a derivative: where a root begins it has none.
const float RL_FIELD_STEEPEST = 1.0e18f;
// Rounding error of an operation, relative; of divisions and roots see fieldWidenCoarsely().
const float RL_FIELD_ROUNDING = 2.384185791015625e-7f;
// Error of sine and cosine (fieldCosSin()).
const float RL_FIELD_WAVE_ERROR = 3.0e-7f;
// Shortest segment over the length of the ray in the box: two crossings closer than that may be
// missed, both.
const float RL_FIELD_SHORTEST = 9.5367431640625e-7f;

// Words of a grid, as uvec4s: low corner of its box and samples along x, cells a unit and samples
// along y, high corner and samples along z, then samples, x fastest. Then blocks of 2^3 cells,
// of 4^3 and so on, up to one: each two uvec4s, FieldBounds.
const uint RL_FIELD_GRID_HEADER = 3u;
// Rounding of an interpolated value, over the largest sample of its cell.
const float RL_FIELD_GRID_ERROR = 1.0e-6f;

struct FieldSlopes {
  vec2 r[RL_FIELD_REGISTERS];  // value, derivative along a direction
};

struct FieldRanges {
  vec4 r[RL_FIELD_REGISTERS];  // least and largest value, least and largest derivative
};

// A shape's box, and where its program stands.
struct Field {
  vec3 low;
  vec3 high;
  uint first;  // uvec4 of SceneData::shapeWords
  uint count;
};

// Samples, between which values are interpolated along each axis in turn.
struct FieldGrid {
  vec3 low;
  vec3 high;
  vec3 scale;  // cells a unit
  uvec3 cells;
  uint samples;  // uvec4 of the first
  uint blocks;
};

// Samples of a cell: x and y in the order 00, 10, 01, 11, at the low z and at the high one.
struct FieldCell {
  vec4 low;
  vec4 high;
};

// Bounds over a part of a grid, derivatives a cell.
struct FieldBounds {
  vec4 valueX;  // least and largest value, of the derivative along x
  vec4 rest;    // the same of the derivatives along y and z
};

RL_NAMESPACE_END

#endif
