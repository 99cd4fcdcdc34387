// svgf, last pass: multiplies by the reflectance, and averages over the frames that show the
// surface at the pixel's centre. Earlier histories follow the film sample, which lies on one side
// of an edge: a filtered pixel at an edge shows one side, and in each frame another one. Only an
// average over time gives the pixel filter's mean of both (temporal antialiasing, the last step of
// Schied et al. 2017).
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/common/average.glsl"
#include "denoise/svgf/store.glsl"
#include "core/temporal_gradients/read.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  vec3 filtered = svgfRead(pixelIndex, gParams.iterations).light * guide.reflectance;
  if (gParams.resolveCap > 0.0f) {
    Average a = averageOfBefore(gBuffers.resolvedBefore, pixelIndex, gParams.resolveTest, true);
    if (!viewIsStill()) a.frames = svgfInView(a.frames, pixelIndex);
    a.frames *= changeHistoryKept(gBuffers.changes, gParams.changes, pixelIndex);
    a.frames = min(a.frames, max(gParams.resolveCap - float(gFrame.stillFrames), 0.0f)) + 1.0f;
    a.mean += (filtered - a.mean) * (1.0f / a.frames);
    averageWrite(gBuffers.resolved, pixelIndex, a);
    filtered = a.mean;
  }
  gBuffers.shown.data[pixelIndex] = filtered;
}
