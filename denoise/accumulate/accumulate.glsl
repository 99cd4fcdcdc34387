// accumulate: the exponential average of the frames that show the same surface. What anyone gets
// for no ray more, and what reuse is measured against.
//
//   shown = history + (radiance - history) / n,   n = min(frames in the history, cap) + 1
//
// Reuse averages frames itself, up to h of them: while a history is younger than that, the radiance
// is the average of all of it and is shown as it is; frames count from then on.
//
// While the camera stands, a pixel's history is its own: the average is unbiased, its weights
// depend on nothing but the frame's number. When it moves, the history is that of the pixel (or
// between the four pixels) that showed the same surface, where the centres of both pass the test
// of visibleMatch(); what fails begins anew. Radiance that changes with the direction of the view,
// and pixels that show more than one surface, then lag behind: biased.

#include "core/changes/read.glsl"

RL_FN History historyOf(uint pixelIndex) {
  uvec4 q = RL_PAST_QUAD(gBuffers.historyBefore, pixelIndex);
  History h;
  h.mean = recordVec3(q);
  h.frames = uintBitsToFloat(q.w);
  return h;
}

// Adds the history of a pixel of the last frame, if it showed the surface.
RL_FN void historyGather(RL_IN(VisibleSurface) here, RL_IN(ivec2) pixel, float weight,
                         RL_INOUT(History) sum, RL_INOUT(float) weights) {
  if (!(weight > 0.0f) || pixel.x < 0 || pixel.y < 0 || pixel.x >= int(gFrame.width) ||
      pixel.y >= int(gFrame.height))
    return;
  uint pixelIndex = uint(pixel.y) * gFrame.width + uint(pixel.x);
  VisibleSurface there = visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, pixelIndex);
  float distanceToCamera = distance(gFrame.camera.posW, here.posW);
  if (!visibleMatch(here, there, distanceToCamera, gParams.minNormalDot, gParams.maxPlaneDistance))
    return;
  History h = historyOf(pixelIndex);
  sum.mean += h.mean * weight;
  sum.frames += h.frames * weight;
  weights += weight;
}

// The last frame's history of what the pixel shows; of no frames where there is none.
RL_FN History historyReprojected(uint pixelIndex) {
  History sum;
  sum.mean = vec3(0.0f, 0.0f, 0.0f);
  sum.frames = 0.0f;
  VisibleSurface here = visibleRead(gBuffers.visible, gFrame.camera, pixelIndex);
  vec2 film;
  if (!visibleFilmBefore(here, film)) return sum;
  float weights = 0.0f;
  if ((gParams.flags & RL_ACCUMULATE_BILINEAR) == 0u) {
    historyGather(here, ivec2(int(film.x), int(film.y)), 1.0f, sum, weights);
  } else {
    float x = floor(film.x - 0.5f);
    float y = floor(film.y - 0.5f);
    float u = film.x - 0.5f - x;
    float v = film.y - 0.5f - y;
    ivec2 corner = ivec2(int(x), int(y));
    historyGather(here, corner, (1.0f - u) * (1.0f - v), sum, weights);
    historyGather(here, corner + ivec2(1, 0), u * (1.0f - v), sum, weights);
    historyGather(here, corner + ivec2(0, 1), (1.0f - u) * v, sum, weights);
    historyGather(here, corner + ivec2(1, 1), u * v, sum, weights);
  }
  if (!(weights > 0.0f)) return sum;
  sum.mean *= 1.0f / weights;
  sum.frames *= 1.0f / weights;
  return sum;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  History history;
  history.mean = vec3(0.0f, 0.0f, 0.0f);
  history.frames = 0.0f;
  if (gFrame.stillFrames != 0u) {
    history = historyOf(pixelIndex);
  } else if (gFrame.frame > 0u) {
    history = historyReprojected(pixelIndex);
  }
  history.frames *= changeKept(gBuffers.changes, gParams.changes, pixelIndex);
  vec3 radiance = gBuffers.radiance.data[pixelIndex];
  if (rlIsFinite3(radiance)) {
    float held = max(gFrame.radianceFrames - 1.0f, 0.0f);
    history.frames = min(history.frames, gParams.cap + held) + 1.0f;
    float weight = 1.0f / max(history.frames - held, 1.0f);
    history.mean = history.mean * (1.0f - weight) + radiance * weight;
  } else {
    // It would stay in every later mean.
    RL_HEALTH(RL_HEALTH_NONFINITE);
  }
  gBuffers.accumulated.data[pixelIndex] = history.mean;
  RL_WRITE_QUAD(gBuffers.history, pixelIndex,
                recordQuad(history.mean, floatBitsToUint(history.frames)));
}
