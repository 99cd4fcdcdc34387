// svgf, second pass: mean luminance around each pixel, and the variance of that mean. The variance
// comes from a history of some frames; for younger histories from neighbours (Schied et al. 2017,
// section 4.2).
//
// Frames that share samples lie closer to each other than to the true mean. If radiance itself
// averages c frames, a frame brings 1/c of new light, and the difference of one frame and the next
// has the variance 2 v / c, with v the variance of the radiance (an exponential average).
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/svgf/store.glsl"

// Frames from which on a history is not young; between whole numbers, so that rounding does not
// decide.
#define RL_SVGF_YOUNG 3.5f

// Few frames underestimate their variance, because bright ones are rare. With the factor
// 1 + this / frames, a history of one frame allows three times the deviations.
#define RL_SVGF_UNSURE 8.0f

RL_FN bool aroundSees(uint pixelIndex, RL_OUT(float) luminance, RL_OUT(float) variance) {
  SvgfHistory h = svgfHistoryRead(gBuffers.history, pixelIndex);
  luminance = rlLuminance(h.light);
  variance = -1.0f;
  if (!(h.frames > 0.0f)) return false;
  if (h.frames < RL_SVGF_YOUNG || svgfHas(RL_SVGF_SPACE)) return true;
  // Number of independent frames in the mean.
  float held = svgfEffectiveHistoryLength(pixelIndex, h.frames);
  float frames = max(h.frames - held + 1.0f, 1.0f);
  if (svgfHas(RL_SVGF_DIFFERENCES)) {
    variance = 0.5f * h.step * held * min((2.0f * held - 1.0f) / frames, 1.0f);
  } else {
    variance = h.spread / max(frames - 1.0f, 1.0f);
  }
  return true;
}

#include "denoise/common/around.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  LocalLuminance a = aroundOf(pixel);
  SvgfHistory h = svgfHistoryRead(gBuffers.history, pixelIndex);
  float frames = max(h.frames - svgfEffectiveHistoryLength(pixelIndex, h.frames) + 1.0f, 1.0f);
  float unsure = 1.0f + RL_SVGF_UNSURE / frames;
  gBuffers.around.data[pixelIndex] = vec2(a.luminance, a.variance * unsure);
  Filtered f;
  f.light = h.light;
  f.reflectance = 0.0f;
  if (h.frames > 0.0f)
    f.reflectance = rlLuminance(guideRead(gBuffers.guide, pixelIndex).reflectance);
  filterWrite(gBuffers.even, pixelIndex, f);
}
