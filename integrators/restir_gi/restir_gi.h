// Types, buffers and parameters of the `restir_gi` kernels.
#ifndef RL_RESTIR_GI_H
#define RL_RESTIR_GI_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/payload/path_sample.h"
#include "core/payload/path_shift.h"
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// What the initial pass keeps of the pixel's path (integrators/restir_gi/gather.glsl).
struct GiPath {
  vec3 ownLight;  // shaded as it is
  uint film;
  uint isReusable;  // x1: can other pixels use what it receives?
  vec3 x1PosW;
  vec3 x1NGeoW;
  float x1PosError;
  vec3 fX1;  // f |cos| at x1 towards x2
  float pdfX1;
  float passedX1;  // Walk::passed of the ray from x1

  // Direct light at x1.
  LightSample light;  // the light sample that was selected
  real lightSum;      // resampling weights of all light samples
  vec3 lightF;        // integrand of the selected one
  LightSample found;  // the light that the BSDF sample met
  vec3 foundF;
  real foundWeight;
  float foundCoverage;  // of the light that it met: what chance let it meet it

  // Indirect light: the path is cut at x2, `suffixThroughput` is that from x3 on.
  uint hasX2;  // a connectable x2 was found
  PathSample x2;
  vec3 woX2;
  vec3 lightAtX2;  // light sample at x2 over its density, without BSDF and MIS weight at x2
  vec3 lightDirX2;
  float lightPdfX2;
  uint isSuffix;  // beyond x2, on the connectable part
  vec3 suffixThroughput;
  float pdfX2;    // of the continuation at x2
  vec3 weightX2;  // f |cos| / pdf of it
  vec3 dirX2;
  vec3 emittedAtX3;
  float pdfLightAtX3;
  vec3 rest;      // light beyond x3
  vec3 absorbed;  // transmittance up to the vertex under way
  vec3 unseen;    // of the last light sample, without its visibility
};

// The merge over time: of one donor.
struct GiOverTime {
  ReservoirState donor;  // its confidence capped
  Shifted ours;
  Shifted theirs;
  vec3 ratio;
  float u;
};

// The merge over space: of the slot's partners.
struct GiOverSpace {
  uint slot;
  float share;  // of their confidence
  Rng rng;
};

struct RestirGiBuffers {
  Vec3Ref radiance;
  // One quad: light that no other pixel could use, averaged over time; age of the history.
  QuadRef own;
  QuadRef ownBefore;
  QuadRef reservoirs;  // of this frame: initial, then temporal
  QuadRef history;     // of the last frame; replaced by the spatial pass
  QuadRef suffixes;
  QuadRef suffixesHistory;
  // Between the exchange and the spatial pass, spatialNeighbours entries a pixel.
  UintRef partners;  // slots; RL_INVALID: none
  QuadRef shifted;   // one quad: the pixel's sample as the partner sees it
};

struct RestirGiParams {
  uint temporalFlags;  // RL_REUSE_*
  uint spatialFlags;
  uint lightCandidates;
  uint spatialNeighbours;  // of a young history; at least agedNeighbours
  uint agedNeighbours;
  float youngFrames;    // up to this age a history is young
  uint settledFrames;   // after so many still frames none is
  float donorNoise;     // reuseDonorShare()
  uint donorsBySample;  // 1: wrong by design, for the tests that must reject it
  uint temporalReuse;   // 0: off
  float confidenceCap;
  float maxReflectanceRatio;  // per channel, of surfaces, for the carried per-channel estimates
  PathShiftParams shift;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RestirGiBuffers
#define RL_KERNEL_PARAMS RestirGiParams

#endif
