// Buffers of the `layers` kernel: guides from layers of a file, instead of from a scene.
#ifndef RL_LAYERS_H
#define RL_LAYERS_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/gbuffer/guide_data.h"

RL_NAMESPACE_BEGIN

struct LayersBuffers {
  Vec3Ref radiance;
  Vec3Ref normalW;  // unit; 0 where the background is seen
  Vec3Ref albedo;
  Vec3Ref depth;   // metres in the first channel, 0: background; above 0 in the second: a light
  Vec3Ref motion;  // vector to the point's place in the last frame: pixels to the right and down;
                   // depth there, 0 if unknown
  Uvec4Ref guide;
  Uvec4Ref motions;
};

struct LayersParams {
  uint demodulates;  // 0: the radiance is not divided by the albedo
};

// Sums over pixels of one row or column: x in pixels from the pixel in question, y the disparity
// minus that pixel's.
struct LineSums {
  float n;
  float sumX;
  float sumY;
  float sumXX;
  float sumXY;
  float sumYY;
};

// Sums over the pixels to one side while they have the same normal: the first few, and all.
struct LineSide {
  LineSums near;
  LineSums all;
};

struct LineFit {
  float slope;
  float squareError;  // squared error of the slope
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS LayersBuffers
#define RL_KERNEL_PARAMS LayersParams

#endif
