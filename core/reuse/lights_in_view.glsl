// lights_in_view, a pass of new views: light seen directly at the edges of lamps, from the film
// samples of this frame and the next ones. If the view stays, the next frames add nothing.
#include "core/transport/lights_in_view.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint samples = gParams.reuse.lightEdgeSamples;
  bool isSeen = samples != 0u && (gFrame.components & RL_COMPONENT_DIRECT) != 0u &&
                gFrame.pixelFilter == RL_FILTER_BOX;
  bool isEdge = isSeen && lightsEndHere(gBuffers.visible, pixel);
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
  if (isEdge) light = lightsInView(pixel, samples);
  RL_WRITE_QUAD(gBuffers.unresampled, pixelIndex, recordQuad(light, isEdge ? samples : 0u));
}
