// svgf, second pass: the light around each pixel, and how far its mean may be from its truth. A
// history of some frames tells; for a younger one neighbours do (Schied et al. 2017, section 4.2).
//
// Frames that share samples lie closer to each other than to their mean's truth: where radiance
// averages c frames itself, a frame brings 1/c of new light, and what differs from one frame to the
// next has the variance 2 v / c, if v is that of the radiance (an exponential average).
#include "core/kernels/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/svgf/store.glsl"

// Frames; between whole numbers, so that rounding does not decide.
#define RL_SVGF_YOUNG 3.5f

// Few frames tell little of their variance, as bright ones are rare: times 1 + this / frames, a
// history of one frame allows three times the deviations.
#define RL_SVGF_UNSURE 8.0f

RL_FN bool aroundSees(uint slot, RL_OUT(float) luminance, RL_OUT(float) variance) {
  SvgfHistory h = svgfHistoryRead(gBuffers.history, slot);
  luminance = rlLuminance(h.light);
  variance = -1.0f;
  if (!(h.frames > 0.0f)) return false;
  if (h.frames < RL_SVGF_YOUNG || svgfHas(RL_SVGF_SPACE)) return true;
  // Frames in the mean that know nothing of each other.
  float held = svgfHeld(slot, h.frames);
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
  uint slot = slotOfPixel(pixel);
  Around a = aroundOf(pixel);
  SvgfHistory h = svgfHistoryRead(gBuffers.history, slot);
  float frames = max(h.frames - svgfHeld(slot, h.frames) + 1.0f, 1.0f);
  float unsure = 1.0f + RL_SVGF_UNSURE / frames;
  gBuffers.around.data[slot] = vec2(a.luminance, a.variance * unsure);
  Filtered f;
  f.light = h.light;
  f.reflectance = 0.0f;
  if (h.frames > 0.0f) f.reflectance = rlLuminance(guideRead(gBuffers.guide, slot).reflectance);
  filterWrite(gBuffers.even, slot, f);
}
