// atrous, second pass: computes the mean luminance around each pixel.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"

RL_FN bool aroundSees(uint pixelIndex, RL_OUT(float) luminance, RL_OUT(float) variance) {
  Filtered f = filterRead(gBuffers.even, pixelIndex);
  luminance = rlLuminance(f.light);
  variance = -1.0f;
  return f.reflectance > 0.0f;
}

#include "denoise/common/around.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  LocalLuminance a = aroundOf(pixel);
  gBuffers.around.data[pixelIndexOf(pixel)] = vec2(a.luminance, a.variance);
}
