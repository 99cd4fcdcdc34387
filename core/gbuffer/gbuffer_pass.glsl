// gbuffer: surfaces at pixel centres, in frames of a new view. They are traced, one ray per pixel,
// or were rasterised.
#include "core/gbuffer/first_hit.glsl"
#include "core/gbuffer/gbuffer_trace.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  Ray ray = gbufferRay(gFrame.camera, pixelIndex);
  Hit hit = traceNoHit();
  if (gParams.isRaster != 0u) {
    hit = firstHitRead(gBuffers.firstHits, pixelIndex);
    hit.t = firstHitDistance(ray, hit);
  } else {
    traceRay(ray, RL_RAY_PATH, gbufferAlphaKey(pixelIndex), hit);
  }
  gbufferWrite(gBuffers.gbuffer, pixelIndex, gbufferOf(ray, hit), hit.t);
}
