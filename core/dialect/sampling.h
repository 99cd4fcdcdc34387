// Types and dimension constants of random sampling. Every draw names one of the RL_DIM_* constants;
// tests/lint asserts that the numbers are unique and tests/unit that no draw happens twice in a
// frame.
#ifndef RL_SAMPLING_H
#define RL_SAMPLING_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

// Counter-based generator: a draw is a hash of (seed, pixel, frame) = key, vertex and dimension.
struct Rng {
  uvec2 key;
  uint vertex;
};

// Vertex numbers: 0 is the pixel, k the k-th scattering vertex, large ones the reuse passes.
const uint RL_VERTEX_PIXEL = 0u;
const uint RL_VERTEX_TEMPORAL = 0x1000u;
const uint RL_VERTEX_SPATIAL = 0x2000u;  // + number of the round
const uint RL_VERTEX_CACHE_UPDATE = 0x3000u;
const uint RL_VERTEX_CACHE_REUSE = 0x3800u;
const uint RL_VERTEX_CANDIDATES = 0x4000u;  // + index of a light candidate
const uint RL_VERTEX_COLLISION =
    0x10000u;                          // times 1 + the number of the stretch, + the vertex before
const uint RL_VERTEX_TURN = 0x10000u;  // times the level of a hierarchy, + the vertex

// Steps of the R2 sequence, 1/g and 1/g^2 of 2^32, g^3 = g + 1 (Roberts 2018).
const uint RL_R2_STEP_X = 3242174889u;
const uint RL_R2_STEP_Y = 2447445414u;

const uint RL_DIM_FILTER_X = 0u;
const uint RL_DIM_FILTER_Y = 1u;
const uint RL_DIM_LIGHT_SELECT = 2u;
const uint RL_DIM_LIGHT_ALIAS = 3u;
const uint RL_DIM_LIGHT_U = 4u;
const uint RL_DIM_LIGHT_V = 5u;
const uint RL_DIM_BSDF_LOBE = 6u;
const uint RL_DIM_BSDF_U = 7u;
const uint RL_DIM_BSDF_V = 8u;
const uint RL_DIM_ROULETTE = 9u;
const uint RL_DIM_RIS_LIGHT = 10u;     // selection among light candidates
const uint RL_DIM_RIS_DIRECT = 11u;    // light sample or BSDF sample
const uint RL_DIM_RIS_SUFFIX = 12u;    // light from beyond x3 against what is selected so far
const uint RL_DIM_RIS_MERGE = 13u;     // + donor index (4 at most)
const uint RL_DIM_RIS_INDIRECT = 32u;  // indirect light against what is selected of direct light
const uint RL_DIM_RIS_EMITTER = 33u;   // emission at x3, likewise
const uint RL_DIM_RIS_PREFIX = 34u;    // a vertex's light samples against what is selected so far
const uint RL_DIM_RIS_REPLAY = 35u;    // light that a smooth vertex found, likewise
const uint RL_DIM_DONOR_U = 50u;
const uint RL_DIM_DONOR_V = 51u;
const uint RL_DIM_ENVIRONMENT_ALIAS = 52u;
const uint RL_DIM_COLLISION_CHANNEL = 53u;
const uint RL_DIM_COLLISION_DISTANCE = 54u;
const uint RL_DIM_PHASE_U = 55u;
const uint RL_DIM_PHASE_V = 56u;
const uint RL_DIM_EXIT = 57u;        // surface where a diffusion profile leaves a body
const uint RL_DIM_LIGHT_TURN = 58u;  // in the hierarchy of lamps; vertex + RL_VERTEX_TURN a level
const uint RL_DIMENSIONS = 64u;

RL_NAMESPACE_END

#endif
