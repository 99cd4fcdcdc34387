// layers: computes guides (denoiser features) from layers that came with an image.
#include "core/gbuffer/guide_data.glsl"

// Disparity of a pixel; 0 for the background, which has no depth, an infinite one, or no normal.
RL_FN float layersDisparity(uint pixelIndex) {
  float depth = gBuffers.depth.data[pixelIndex].x;
  vec3 nW = gBuffers.normalW.data[pixelIndex];
  if (dot(nW, nW) == 0.0f) return 0.0f;
  // Keep NaN: max(NaN, x) differs between devices.
  return depth < 0.0f ? 0.0f : rlSafeDivide(1.0f, depth);
}

// Pixels on each side that a slope is estimated from. A layer may be of any point within a pixel,
// so that the disparities of a plane at a grazing angle are noisy: a filter that looks 16 pixels
// far needs the slope to a few percent.
#define RL_LAYERS_REACH 8u
#define RL_LAYERS_NEAR 3u

RL_FN LineSums lineNone() {
  LineSums s;
  s.n = 0.0f;
  s.sumX = 0.0f;
  s.sumY = 0.0f;
  s.sumXX = 0.0f;
  s.sumXY = 0.0f;
  s.sumYY = 0.0f;
  return s;
}
RL_FN LineSums lineBoth(RL_IN(LineSums) a, RL_IN(LineSums) b) {
  LineSums s;
  s.n = a.n + b.n;
  s.sumX = a.sumX + b.sumX;
  s.sumY = a.sumY + b.sumY;
  s.sumXX = a.sumXX + b.sumXX;
  s.sumXY = a.sumXY + b.sumXY;
  s.sumYY = a.sumYY + b.sumYY;
  return s;
}

RL_FN LineSide lineAlong(uvec2 pixel, ivec2 side, float direction, RL_IN(vec3) nW, float here) {
  LineSide line;
  line.all = lineNone();
  line.near = line.all;
  for (uint i = 1u; i <= RL_LAYERS_REACH; i = i + 1u) {
    ivec2 at = ivec2(int(pixel.x), int(pixel.y)) + side * int(i);
    if (at.x < 0 || at.y < 0 || at.x >= int(gFrame.width) || at.y >= int(gFrame.height)) break;
    uint pixelIndex = uint(at.y) * gFrame.width + uint(at.x);
    float there = layersDisparity(pixelIndex);
    if (!(there > 0.0f) || !(dot(nW, gBuffers.normalW.data[pixelIndex]) > 0.95f)) break;
    float x = float(i) * direction;
    float y = there - here;
    line.all.n += 1.0f;
    line.all.sumX += x;
    line.all.sumY += y;
    line.all.sumXX += x * x;
    line.all.sumXY += x * y;
    line.all.sumYY += y * y;
    if (i <= RL_LAYERS_NEAR) line.near = line.all;
  }
  return line;
}

// Returns the better one of `best` and the least-squares line through the pixel (x = y = 0) and the
// pixels of `s`. Pixels beyond an edge make the residual, and with it the error, large.
RL_FN LineFit lineBetter(RL_IN(LineFit) best, RL_IN(LineSums) s, float here) {
  float n = s.n + 1.0f;
  if (!(s.n > 0.0f)) return best;
  float spread = s.sumXX - s.sumX * s.sumX / n;
  LineFit fit;
  fit.slope = (s.sumXY - s.sumX * s.sumY / n) / spread;
  float residual = s.sumYY - s.sumY * s.sumY / n - fit.slope * (s.sumXY - s.sumX * s.sumY / n);
  // Bound the residual by rounding: below that bound the longer line is the better one.
  residual = max(residual, 1.0e-11f * here * here);
  // Too few pixels lie on a line by chance.
  fit.squareError = n < 4.0f ? 1.0e30f : residual / ((n - 2.0f) * spread);
  if (!(fit.squareError < best.squareError)) return best;
  return fit;
}

// Change of the disparity from one pixel to the next one along `side`.
RL_FN float layersSlope(uvec2 pixel, ivec2 side, RL_IN(vec3) nW, float here) {
  LineSide before = lineAlong(pixel, -side, -1.0f, nW, here);
  LineSide after = lineAlong(pixel, side, 1.0f, nW, here);
  LineFit best;
  best.slope = 0.0f;
  best.squareError = 2.0e30f;
  best = lineBetter(best, lineBoth(before.all, after.all), here);
  best = lineBetter(best, before.all, here);
  best = lineBetter(best, after.all, here);
  best = lineBetter(best, lineBoth(before.near, after.near), here);
  best = lineBetter(best, before.near, here);
  best = lineBetter(best, after.near, here);
  return best.slope;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Guide g;
  g.nW = gBuffers.normalW.data[pixelIndex];
  g.disparity = layersDisparity(pixelIndex);
  g.isLight = g.disparity > 0.0f && !(gBuffers.depth.data[pixelIndex].y > 0.0f) ? 0u : 1u;
  if (!rlIsFinite3(g.nW) || !rlIsFinite(g.disparity)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    g.nW = vec3(0.0f, 0.0f, 0.0f);
    g.disparity = 0.0f;
    g.isLight = 1u;
  }
  g.slope.x = layersSlope(pixel, ivec2(1, 0), g.nW, g.disparity);
  g.slope.y = layersSlope(pixel, ivec2(0, 1), g.nW, g.disparity);
  g.reflectance = vec3(1.0f, 1.0f, 1.0f);
  vec3 albedo = gBuffers.albedo.data[pixelIndex];
  if (g.isLight == 0u && gParams.demodulates != 0u && rlIsFinite3(albedo)) {
    g.reflectance =
        clamp(albedo, vec3(RL_GUIDE_FLOOR, RL_GUIDE_FLOOR, RL_GUIDE_FLOOR), vec3(1.0f, 1.0f, 1.0f));
  }
  guideWrite(gBuffers.guide, pixelIndex, g);
  vec3 motion = gBuffers.motion.data[pixelIndex];
  Motion m;
  m.film = vec2(motion.x, motion.y);
  m.disparity = motion.z > 0.0f ? 1.0f / motion.z - g.disparity : 0.0f;
  m.turn = 0.0f;
  motionWrite(gBuffers.motions, pixelIndex, m);
}
