// restir_gi, pass of new views: light seen directly at the edges of lights. In a still view the
// frames' film samples average it.
#include "core/transport/lights_in_view.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = pixel.y * gFrame.width + pixel.x;
  uint samples = gParams.lightEdgeSamples;
  bool isEdge = samples != 0u && (gFrame.components & RL_COMPONENT_DIRECT) != 0u &&
                lightsEndHere(gBuffers.visible, pixel);
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
  if (isEdge) light = lightsInView(pixel, samples);
  RL_WRITE_QUAD(gBuffers.own, slot, recordQuad(light, isEdge ? 1u : 0u));
}
