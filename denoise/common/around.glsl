// Mean luminance around a pixel, weighted by surface alone, and the variance of that mean.
//
// The includer has gParams.edges and gBuffers.guide, and defines before the #include:
//   bool aroundSees(uint pixelIndex, RL_OUT(float) luminance, RL_OUT(float) variance)
//       luminance and variance of a pixel; the variance is below 0 if it must be estimated from
//       neighbours. Returns false if the pixel has no light
#include "denoise/common/spline.glsl"

// Spacing of the nine pixels.
#define RL_AROUND_APART 1u

RL_FN LocalLuminance aroundOf(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  float sum = 0.0f;
  float squares = 0.0f;
  float variances = 0.0f;
  float weights = 0.0f;
  float weightSquares = 0.0f;
  bool isKnown = true;
  // Sum differences to one of the values: sums of the values would lose digits.
  float base;
  float ignored;
  if (!aroundSees(pixelIndex, base, ignored)) base = 0.0f;
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
    if (other != pixelIndex) {
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
  LocalLuminance a;
  float mean = rlSafeDivide(sum, weights);
  a.luminance = base + mean;
  // The share of one pixel's variance that is left in the mean.
  float share = rlSafeDivide(weightSquares, weights * weights);
  float spread = max(rlSafeDivide(squares, weights) - mean * mean, 0.0f);
  a.variance = isKnown ? rlSafeDivide(variances, weights * weights)
                       : rlSafeDivide(spread * share, max(1.0f - share, 0.0f));
  return a;
}
