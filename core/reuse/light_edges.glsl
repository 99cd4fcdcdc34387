// light_edges, a pass of new views: antialiasing of lamps that the camera sees. A pixel at a lamp's
// edge takes several camera rays at once, at the film samples that the next still frames would use.
// If the view then stays still, those frames find the same light once more: the initial pass gives
// their unresampled light the weight 0.
#include "core/transport/light_edges.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint samples = gParams.reuse.lightEdgeSamples;
  bool isSeen = samples != 0u && (gFrame.components & RL_COMPONENT_DIRECT) != 0u &&
                gFrame.pixelFilter == RL_FILTER_BOX;
  bool isEdge = isSeen && lightsEndHere(gBuffers.gbuffer, pixel);
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
  if (isEdge) light = lightEdges(pixel, samples);
  RL_WRITE_UVEC4(gBuffers.unresampled, pixelIndex, recordUvec4(light, isEdge ? samples : 0u));
}
