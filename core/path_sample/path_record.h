// State of a path that is gathered for a reservoir.
#ifndef RL_PATH_RECORD_H
#define RL_PATH_RECORD_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/path_sample/path_replay.h"
#include "core/path_sample/path_sample.h"
#include "core/radiance_cache/radiance.h"
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// Data gathered from a pixel's path (core/path_sample/path_record.glsl).
struct PathRecord {
  vec3 unresampledRadiance;  // light that no other pixel could reuse; not in any reservoir
  vec3 inView;               // emission that the camera sees, and direct light of mirrors it sees
  uint isMirrored;           // 1: all vertices so far are mirrors
  uint film;
  uint isReusable;  // 1: other pixels can reuse the light that x1 receives
  vec3 x1PosW;
  vec3 x1NGeoW;
  float x1PosError;
  vec3 fX1;  // f |cos| at x1 towards x2
  float pdfX1;
  float alphaTransmittanceX1;  // Walk::passed of the ray from x1

  // Direct light at x1.
  LightSample light;  // selected light sample
  real lightSum;      // sum of the resampling weights of all light samples
  vec3 lightF;        // integrand of the selected light sample
  LightSample found;  // light that the BSDF sample hit
  vec3 bsdfHitIntegrand;
  real bsdfHitWeight;
  float bsdfHitCoverage;    // alpha of the light that was hit: probability that the ray hit it
  uint isLightUnresampled;  // 1: the last light sample is not resampled

  // Indirect light. The path is cut at x2; `suffixThroughput` is the throughput from x3 on.
  uint isX2Unresampled;  // 1: x2 lies between two bodies, which its id does not tell: not reused
  uint hasX2;            // a connectable x2 was found
  PathSample x2;
  Surface surfaceX2;
  vec3 lightAtX2;  // light sample at x2 over its density, without BSDF and MIS weight at x2
  vec3 lightDirX2;
  float lightPdfX2;
  uint isSuffix;  // 1: the walk is beyond x2, on the reconnectable part
  vec3 suffixThroughput;
  float pdfX2;    // density of the continuation at x2
  vec3 weightX2;  // f |cos| / pdf of the continuation at x2
  vec3 dirX2;
  vec3 emittedAtX3;
  float pdfLightAtX3;
  vec3 suffixRadiance;          // light beyond x3
  vec3 mediumTransmittance;     // transmittance of the last segment
  vec3 unshadowedContribution;  // unshadowed contribution of the last light sample

  // With RL_PATH_REPLAYS x1 is the vertex after `base` events.
  uint base;
  uint key;                 // of the random numbers of the path
  PathConnector connector;  // of x1
  vec3 prefix;              // throughput up to x1, without Russian roulette
  float roulette;           // product of the factors of Russian roulette up to the reconnection
  vec3 sigmaX1;             // m^-1, of the medium of the segment from x1
  uint rankX1;              // of its body

  // Selected so far.
  PathReservoir chosen;
  real wSum;
  vec3 estimate;
  CacheTermination end;
};

RL_NAMESPACE_END

#endif
