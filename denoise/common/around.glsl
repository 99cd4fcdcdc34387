// The mean luminance around a pixel, by surface alone, and the variance of that mean.
//
// The includer defines, before the #include:
//   bool aroundSees(uint slot, RL_OUT(float) luminance, RL_OUT(float) variance)   of a pixel; the
//       variance is below 0 where only its neighbours can tell. False where it has no light
// and has gParams.edges and gBuffers.guide.
#include "denoise/common/spline.glsl"

// Of nine pixels, so many apart.
#define RL_AROUND_APART 1u

RL_FN Around aroundOf(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Guide guide = guideRead(gBuffers.guide, slot);
  float sum = 0.0f;
  float squares = 0.0f;
  float variances = 0.0f;
  float weights = 0.0f;
  float weightSquares = 0.0f;
  bool isKnown = true;
  // Sums are of differences to one of the numbers: they keep their digits.
  float base;
  float ignored;
  if (!aroundSees(slot, base, ignored)) base = 0.0f;
  FilterSurface surface = filterSurface(guide, gParams.edges);
  for (uint i = 0u; i < 9u; i = i + 1u) {
    uint row = i / 3u;
    uint column = i % 3u;
    uint x;
    uint y;
    if (!splineAt(pixel.y, row, RL_AROUND_APART, gFrame.height, y) ||
        !splineAt(pixel.x, column, RL_AROUND_APART, gFrame.width, x))
      continue;
    uint other = y * gFrame.width + x;
    float weight = splineWeight(row) * splineWeight(column);
    if (other != slot) {
      float dx = (float(column) - 1.0f) * float(RL_AROUND_APART);
      float dy = (float(row) - 1.0f) * float(RL_AROUND_APART);
      weight *= filterEdge(surface, guideSurface(gBuffers.guide, other), dx, dy);
    }
    float luminance;
    float variance;
    if (!(weight > 0.0f) || !aroundSees(other, luminance, variance)) continue;
    if (variance < 0.0f) isKnown = false;
    float difference = luminance - base;
    sum += difference * weight;
    squares += difference * difference * weight;
    variances += variance * weight * weight;
    weights += weight;
    weightSquares += weight * weight;
  }
  Around a;
  float mean = rlSafeDivide(sum, weights);
  a.luminance = base + mean;
  // The share of one pixel's variance that is left in the mean.
  float share = rlSafeDivide(weightSquares, weights * weights);
  float spread = max(rlSafeDivide(squares, weights) - mean * mean, 0.0f);
  a.variance = isKnown ? rlSafeDivide(variances, weights * weights)
                       : rlSafeDivide(spread * share, max(1.0f - share, 0.0f));
  return a;
}
