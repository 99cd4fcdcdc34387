// accumulate: the exponential average of the frames that show the same surface. Costs no ray, and
// is the baseline that reuse is measured against.
//
//   shown = history + (radiance - history) / n,   n = min(frames in the history, cap) + 1
//
// Reuse averages frames itself, up to h of them: while a history is younger than h, the radiance is
// the average of all of its frames and is shown unchanged; frames count from then on.
//
// In a still view a pixel's history is its own: the average is unbiased, because its weights depend
// on the frame's number alone. In a moving view the history is read at the pixel (or between the
// four pixels) that showed the same surface, if the centres of both pass gbufferMatch(); otherwise
// the history is reset. Radiance that changes with the direction of the view, and pixels that show
// more than one surface, then lag behind: biased.

#include "core/temporal_gradients/read.glsl"
#include "denoise/common/average.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  bool isBetween = (gParams.flags & RL_ACCUMULATE_BILINEAR) != 0u;
  Average history =
      averageOfBefore(gBuffers.historyBefore, pixelIndex, gParams.similarity, isBetween);
  history.frames *= changeHistoryKept(gBuffers.changes, gParams.changes, pixelIndex);
  if (!(history.frames > 0.0f)) RL_HEALTH(RL_HEALTH_NEW_HISTORY);
  vec3 radiance = gBuffers.radiance.data[pixelIndex];
  if (rlIsFinite3(radiance)) {
    float held = max(gFrame.radianceFrames - 1.0f, 0.0f);
    history.frames = min(history.frames, gParams.cap + held) + 1.0f;
    float weight = 1.0f / max(history.frames - held, 1.0f);
    history.mean = history.mean * (1.0f - weight) + radiance * weight;
  } else {
    // Skip NaN and Inf, which would stay in every later mean.
    RL_HEALTH(RL_HEALTH_NONFINITE);
  }
  gBuffers.accumulated.data[pixelIndex] = history.mean;
  averageWrite(gBuffers.history, pixelIndex, history);
}
