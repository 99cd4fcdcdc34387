// Path sample of a reservoir: a film sample, and the light that the first vertex x1 receives. x1
// itself is not stored: the ray through the film sample finds it, in this pixel or in another. 64
// bytes with its state, whatever the BSDF of x2.
#ifndef RL_PATH_SAMPLE_H
#define RL_PATH_SAMPLE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/resampling/reservoir.h"

RL_NAMESPACE_BEGIN

// Kinds of paths. Each is a domain of its own: no shift leads from one to another.
const uint RL_PATH_DIRECT = 0u;        // x1 lit by a point of a light or by a direction
const uint RL_PATH_LAMBERT = 1u;       // Lambert x2: `radiance` leaves x2 in every direction
const uint RL_PATH_LIGHT_SAMPLE = 2u;  // glossy x2, lit by a light sample from wi
const uint RL_PATH_EMITTER = 3u;       // glossy x2, continued in direction wi to an x3 that emits
const uint RL_PATH_CONTINUATION = 4u;  // glossy x2, continued in direction wi and beyond x3
// With RL_PATH_REPLAYS (core/path_sample/path_replay.glsl):
const uint RL_PATH_WEIGHED = 5u;       // as RL_PATH_DIRECT, where x1 is smooth: with its MIS weight
const uint RL_PATH_WHOLE_REPLAY = 6u;  // no reconnection: an emitter that a smooth x1 found

// A path holds ids, not what the scene says of them: x2 is evaluated anew wherever it is used.
struct PathSample {
  SurfaceId id;   // x2, or the point of an emitting triangle; punctual lights: id.instance is the
                  // index in the light table
  uint kind;      // RL_PATH_*; light: plus RL_LIGHT_* << 3; plus RL_PATH_TWO_SIDED or _BACK; 8 bits
  uint film;      // the film sample: cameraFilmBits()
  vec3 radiance;  // x2: sent towards x1, or incident from wi; light: LightSample::radiance
  float geometry;  // x2: |cos| / d^2 towards x1 of the pixel that holds it; light: 0
  vec3 wi;         // glossy x2; or the direction to the environment. As pathPackedWi() gives it
  float pdfLight;  // glossy x2: solid-angle density of light sampling for wi, as pathPackedPdf()
                   // gives it; 0: no competing technique
  // With RL_PATH_REPLAYS, where x1 stands for the vertex before the one that reconnects:
  uint base;  // scattering events before that x1, which a shift replays
  uint key;   // of the random numbers that it replays
};

// The first coordinate of a shape has its part (at most 8) and 15 bits.
const uint RL_DIRECT_PART_SHIFT = 15u;
const uint RL_DIRECT_PART_GRID = 0x7fffu;
const uint RL_DIRECT_GRID = 0x3ffffu;  // core/path_sample/direct_sample.glsl: 18 bits a coordinate
const uint RL_PATH_KIND_MASK = 7u;
const uint RL_PATH_LIGHT_KIND_SHIFT = 3u;
const uint RL_PATH_LIGHT_KIND_MASK = 7u;
const uint RL_PATH_TWO_SIDED = 0x40u;  // light: shines to both sides
const uint RL_PATH_BACK = 0x80u;       // x2: x1 is behind the triangle

// In the kernels' gParams.path.
struct PathParams {
  uint lightCandidates;   // light samples at x1, of which one is kept
  float minAlpha;         // GGX alpha below which x1 is not reused
  float maxJacobian;      // shifts outside [1/x, x] are undefined, both ways (Lin et al. 2022)
  uint unshadowedTarget;  // 1: targets lack visibility (RL_DIRECT_ONLY)
  // With RL_PATH_REPLAYS:
  uint mostReplayed;  // scattering events that a shift replays at most
  float footprint;    // least area of a connectable vertex, as a share of that of x1; 0: any
};

const uint RL_PATH_MOST_REPLAYED = 15u;  // 4 bits: core/path_sample/replay_words.glsl

struct PathReservoir {
  PathSample path;
  ReservoirState state;
};

// Number of uvec4s in a buffer: of the sample (its radiance is stored with the state), and of
// sample and state.
const uint RL_PATH_SAMPLE_UVEC4S = 2u;
const uint RL_PATH_RESERVOIR_UVEC4S = RL_PATH_SAMPLE_UVEC4S + RL_STATE_UVEC4S;
// The same of methods that resample direct light alone.
const uint RL_DIRECT_RESERVOIR_UVEC4S = 2u;

RL_NAMESPACE_END

#endif
