// Averages of the last frame, and their reprojection: an average follows the surface at the pixel's
// centre. Centres do not depend on film samples, so that a pixel at an edge averages both of its
// sides, as the pixel filter does.
//
// The includer has gBuffers.gbuffer and .gbufferPrevious.
#include "denoise/common/between.glsl"

RL_FN Average averageOfNone() {
  Average a;
  a.mean = vec3(0.0f, 0.0f, 0.0f);
  a.frames = 0.0f;
  return a;
}
RL_FN Average averageRead(RL_IN(Uvec4Ref) words, uint pixelIndex) {
  uvec4 q = RL_EARLIER_UVEC4(words, pixelIndex);
  Average a;
  a.mean = recordVec3(q);
  a.frames = uintBitsToFloat(q.w);
  return a;
}
RL_FN void averageWrite(RL_IN(Uvec4Ref) words, uint pixelIndex, RL_IN(Average) a) {
  RL_WRITE_UVEC4(words, pixelIndex, recordUvec4(a.mean, floatBitsToUint(a.frames)));
}

// Adds the average of a pixel of the last frame, if it showed the surface.
RL_FN void averageGather(RL_IN(Uvec4Ref) before, RL_IN(GBufferTexel) here, RL_IN(vec3) nGeoW,
                         float distanceToCamera, RL_IN(SimilarityThresholds) test,
                         RL_IN(ivec2) pixel, float weight, RL_INOUT(Average) sum,
                         RL_INOUT(float) weights) {
  if (!(weight > 0.0f) || pixel.x < 0 || pixel.y < 0 || pixel.x >= int(gFrame.width) ||
      pixel.y >= int(gFrame.height))
    return;
  uint pixelIndex = uint(pixel.y) * gFrame.width + uint(pixel.x);
  GBufferTexel there = gbufferRead(gBuffers.gbufferPrevious, gFrame.previousCamera, pixelIndex);
  if (!gbufferMatchOf(here, nGeoW, there, distanceToCamera, test)) return;
  Average a = averageRead(before, pixelIndex);
  // Skip pixels that were never finite: having no average is not the same as a black one.
  if (!(a.frames > 0.0f)) return;
  sum.mean += a.mean * weight;
  sum.frames += a.frames * weight;
  weights += weight;
}

// Returns the last frame's average of the surface that the pixel shows, read between four pixels or
// from the nearest one; zero frames if there is none.
RL_FN Average averageReprojected(RL_IN(Uvec4Ref) before, uint pixelIndex,
                                 RL_IN(SimilarityThresholds) test, bool isBetween) {
  Average sum = averageOfNone();
  GBufferTexel here = gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex);
  vec2 film;
  if (!filmPointPrevious(here, film)) return sum;
  vec3 nGeoW = unpackNormal(here.nGeoW);
  float distanceToCamera = distance(gFrame.camera.posW, here.posW);
  float x = floor(film.x - 0.5f);
  float y = floor(film.y - 0.5f);
  float u = film.x - 0.5f - x;
  float v = film.y - 0.5f - y;
  ivec2 corner = ivec2(int(x), int(y));
  if (!isBetween) {
    corner = ivec2(int(film.x), int(film.y));
    u = 0.0f;
    v = 0.0f;
  }
  float weights = 0.0f;
  for (uint i = 0u; i < 4u; i = i + 1u) {
    int right = int(i & 1u);
    int below = int(i >> 1u);
    float weight = (right != 0 ? u : 1.0f - u) * (below != 0 ? v : 1.0f - v);
    averageGather(before, here, nGeoW, distanceToCamera, test, corner + ivec2(right, below), weight,
                  sum, weights);
  }
  if (!(weights > 0.0f)) return sum;
  sum.mean *= 1.0f / weights;
  sum.frames *= 1.0f / weights;
  if (isBetween) sum.frames *= betweenShareInView(film);
  return sum;
}

// Returns the average of the pixel itself in a still view, the reprojected one in a new view.
RL_FN Average averageOfBefore(RL_IN(Uvec4Ref) before, uint pixelIndex,
                              RL_IN(SimilarityThresholds) test, bool isBetween) {
  if (viewIsStill()) return averageRead(before, pixelIndex);
  if (isFirstFrame()) return averageOfNone();
  return averageReprojected(before, pixelIndex, test, isBetween);
}
