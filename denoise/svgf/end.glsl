// svgf, last pass: multiplies by the reflectance, and averages over the frames that show the
// surface at the pixel's centre. Earlier histories follow the film sample, which lies on one side
// of an edge: a filtered pixel at an edge shows one side, and in each frame another one. Only an
// average over time gives the pixel filter's mean of both (temporal antialiasing, the last step of
// Schied et al. 2017).
#include "core/kernels/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/common/average.glsl"
#include "denoise/svgf/store.glsl"
#include "core/changes/read.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Guide guide = guideRead(gBuffers.guide, slot);
  vec3 filtered = svgfRead(slot, gParams.iterations).light * guide.reflectance;
  if (gParams.resolveCap > 0.0f) {
    Average a = averageOfBefore(gBuffers.resolvedBefore, slot, gParams.resolveTest, true);
    if (gFrame.stillFrames == 0u) a.frames = svgfInView(a.frames, slot);
    a.frames *= changeKept(gBuffers.changes, gParams.changes, slot);
    a.frames = min(a.frames, max(gParams.resolveCap - float(gFrame.stillFrames), 0.0f)) + 1.0f;
    a.mean += (filtered - a.mean) * (1.0f / a.frames);
    averageWrite(gBuffers.resolved, slot, a);
    filtered = a.mean;
  }
  gBuffers.shown.data[slot] = filtered;
}
