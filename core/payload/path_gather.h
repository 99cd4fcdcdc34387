// What becomes of a path on its way to a reservoir.
#ifndef RL_PATH_GATHER_H
#define RL_PATH_GATHER_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/payload/path_sample.h"
#include "core/radiance/radiance.h"
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// What is kept of a pixel's path (core/payload/path_gather.glsl).
struct PathGather {
  vec3 ownLight;  // that no other pixel could use: no reservoir has it
  vec3 inView;    // emission and environment that the camera sees directly
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
  RadianceEnd end;
};

RL_NAMESPACE_END

#endif
