// Buffers of the `layers` kernel: guides from layers of a file, instead of from a scene.
#ifndef RL_LAYERS_H
#define RL_LAYERS_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/kernels/guide_data.h"

RL_NAMESPACE_BEGIN

struct LayersBuffers {
  Vec3Ref radiance;
  Vec3Ref normalW;  // unit; 0 where the background is seen
  Vec3Ref albedo;
  Vec3Ref depth;   // metres in the first channel, 0: background; above 0 in the second: a light
  Vec3Ref motion;  // pixels to the right and down to where the last frame showed it; its depth
                   // then, or 0 where it is not known
  QuadRef guide;
  QuadRef guideBefore;
  QuadRef motions;
};

struct LayersParams {
  uint demodulates;  // 0: nothing is divided by
};

// Sums over pixels of one row or column: x in pixels from the pixel in question, y the disparity
// less its own.
struct LineSums {
  float n;
  float sumX;
  float sumY;
  float sumXX;
  float sumXY;
  float sumYY;
};

// Those of the pixels to one side as long as they have the same normal: the first few, and all.
struct LineSide {
  LineSums near;
  LineSums all;
};

struct LineFit {
  float slope;
  float squareError;  // of the slope
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS LayersBuffers
#define RL_KERNEL_PARAMS LayersParams

#endif
