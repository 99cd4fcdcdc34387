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
const uint RL_FIELD_KINDS = 16u;

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

RL_NAMESPACE_END

#endif
