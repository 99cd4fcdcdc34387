// Buffers and parameters of the kernels of `svgf` and its kin.
#ifndef RL_SVGF_H
#define RL_SVGF_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/temporal_gradients/changes.h"
#include "denoise/common/average.h"
#include "denoise/common/filter.h"

RL_NAMESPACE_BEGIN

// SvgfParams::flags
const uint RL_SVGF_FEEDBACK = 1u;     // the history keeps the result of the first iteration
const uint RL_SVGF_CONFIDENCE = 2u;   // do not average frames that the radiance averages itself
const uint RL_SVGF_DIFFERENCES = 4u;  // variance by differences of frames that share samples
const uint RL_SVGF_SPACE = 8u;        // variance over neighbours alone
const uint RL_SVGF_EFFECTIVE = 16u;   // SvgfBuffers::radianceFrames is there

// History of a pixel: three uvec4s.
struct SvgfHistory {
  vec3 light;    // mean radiance over mean reflectance of the frames
  float frames;  // number of frames in the means, capped; no whole number if read between pixels
  vec3 reflectance;
  float mean;    // mean luminance of single frames
  float spread;  // variance of the luminance of single frames
  float step;    // mean of the squared difference of one frame's luminance and the next one's
  float last;    // the last frame's luminance
};
const uint RL_SVGF_HISTORY_UVEC4S = 3u;

struct SvgfBuffers {
  Vec3Ref radiance;
  Uvec4Ref guide;
  Uvec4Ref guidePrevious;
  Uvec4Ref motion;
  FloatRef radianceFrames;  // of the radiance; null where all pixels have gFrame.radianceFrames
  UintRef changes;          // core/temporal_gradients
  Uvec4Ref gbuffer;         // null where resolveCap is 0
  Uvec4Ref gbufferPrevious;
  Vec3Ref shown;
  Uvec4Ref even;  // Filtered, a uvec4 each: read by iterations 0, 2, ... and written by the others
  Uvec4Ref odd;
  Vec2Ref around;
  Uvec4Ref history;
  Uvec4Ref historyBefore;
  Uvec4Ref resolved;  // Average of the output
  Uvec4Ref resolvedBefore;
};

struct SvgfParams {
  uint step;  // iteration of the pass
  uint iterations;
  uint flags;
  float cap;  // frames that a history may weigh
  float deviations;
  FilterEdges edges;
  ChangeParams changes;
  float lobeRotationResponse;  // share of a history that is forgotten, over Motion::turn
  float resolveCap;            // frames that a resolved history may weigh
  SimilarityThresholds resolveTest;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS SvgfBuffers
#define RL_KERNEL_PARAMS SvgfParams

#endif
