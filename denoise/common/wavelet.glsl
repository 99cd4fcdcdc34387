// One iteration of an edge-avoiding a-trous wavelet transform (Dammertz, Sewtz, Hanika and Lensch,
// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", 2010):
// exchanges light between pixels that lie 2^step apart, by their similarity. The paper's iteration
// reads 5x5 pixels; 3x3 pixels have a third of the cost and half of the reach.
//
// Differences from the paper: light is compared by means around pixels (around.glsl) instead of the
// pixels themselves, and the result is not divided by the sum of weights. A pixel keeps the light
// that it does not get from a neighbour, and a pair exchanges equal shares: the filter keeps
// energy.
//
// The includer has gParams.step, .edges and .deviations, gBuffers.guide and .around, and defines
// before the #include:
//   Filtered waveletRead(uint pixelIndex)   result of the previous iteration
#include "denoise/common/spline.glsl"

RL_FN Filtered waveletStep(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Filtered here = waveletRead(pixelIndex);
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  if (guide.isLight != 0u) return here;
  FilterSurface surface = filterSurface(guide, gParams.edges);
  LocalLuminance around = aroundRead(gBuffers.around, pixelIndex);
  float squareDeviations = gParams.deviations * gParams.deviations;
  uint reach = 1u << gParams.step;
  // Scale weights by min(reflectance there, here) / here: a pair exchanges equal radiance.
  float perReflectance = rlSafeDivide(1.0f, here.reflectance);
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
  float weights = 0.0f;
  for (uint i = 0u; i < 9u; i = i + 1u) {
    uint row = i / 3u;
    uint column = i % 3u;
    uint x;
    uint y;
    if (i == 4u || !splineAt(pixel.y, row, reach, gFrame.height, y) ||
        !splineAt(pixel.x, column, reach, gFrame.width, x))
      continue;
    uint other = y * gFrame.width + x;
    float dx = (float(column) - 1.0f) * float(reach);
    float dy = (float(row) - 1.0f) * float(reach);
    float weight = filterEdge(surface, guideSurface(gBuffers.guide, other), dx, dy);
    if (!(weight > 0.0f)) continue;
    Filtered there = waveletRead(other);
    weight *= splineWeight(row) * splineWeight(column);
    weight *= filterLikeness(around, aroundRead(gBuffers.around, other), squareDeviations);
    if (here.reflectance > 0.0f) {
      weight *= min(there.reflectance * perReflectance, 1.0f);
    } else if (!(there.reflectance > 0.0f)) {
      continue;
    }
    light += there.light * weight;
    weights += weight;
  }
  if (here.reflectance > 0.0f) {
    here.light += light - here.light * weights;
  } else if (weights > 0.0f) {
    // A pixel without finite light shows the mean of its neighbours, and others do not read it.
    here.light = light * (1.0f / weights);
  }
  return here;
}
