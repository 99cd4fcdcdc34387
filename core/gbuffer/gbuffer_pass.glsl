// gbuffer: surfaces at pixel centres. One ray per pixel, in frames of a new view.

#include "core/gbuffer/gbuffer_trace.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  float distanceToCamera;
  GBufferTexel v = gbufferTrace(gFrame.camera, pixelIndex, distanceToCamera);
  gbufferWrite(gBuffers.gbuffer, pixelIndex, v, distanceToCamera);
}
