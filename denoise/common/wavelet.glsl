// One iteration of an edge-avoiding a-trous wavelet transform (Dammertz, Sewtz, Hanika and Lensch,
// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", 2010): an
// exchange of light between pixels that lie 2^step apart, by how alike they are. The paper's
// iteration asks 5x5 pixels; of 3x3 the cost is a third, and the reach half.
//
// What differs from the paper: light is told by means around pixels (around.glsl) instead of the
// pixels themselves, and the sum of weights is not divided by. What a pixel does not get from a
// neighbour it keeps, and a pair gives each other the same share: the filter keeps energy.
//
// The includer has gParams.step, .edges and .deviations, gBuffers.guide and .around, and defines
// before the #include:
//   Filtered waveletRead(uint slot)   what the iteration before left
#include "denoise/common/spline.glsl"

RL_FN Filtered waveletStep(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Filtered here = waveletRead(slot);
  Guide guide = guideRead(gBuffers.guide, slot);
  if (guide.isLight != 0u) return here;
  FilterSurface surface = filterSurface(guide, gParams.edges);
  Around around = aroundRead(gBuffers.around, slot);
  float squareDeviations = gParams.deviations * gParams.deviations;
  uint reach = 1u << gParams.step;
  // A darker surface gives less light away than a brighter one, and takes as much.
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
    // It has nothing to keep: it shows what its neighbours do, and nobody asks it.
    here.light = light * (1.0f / weights);
  }
  return here;
}
