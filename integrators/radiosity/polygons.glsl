// Pass over chunks of the elements that an unknown may see, once a scene: its row of the system by
// polygons.
#include "integrators/radiosity/visible_factor.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  uint chunks = (gParams.elements + RL_RADIOSITY_CHUNK - 1u) / RL_RADIOSITY_CHUNK;
  uint unknown = entry / chunks;
  if (unknown >= gParams.unknowns) return;
  Surface from = meshUnknown(unknown);
  uint first = (entry % chunks) * RL_RADIOSITY_CHUNK;
  uint end = RL_LESSER(first + RL_RADIOSITY_CHUNK, gParams.elements);
  for (uint element = first; element < end; element = element + 1u) {
    uint side;
    float factor = visibleFactor(from, element, side);
    // The sign is the side.
    gBuffers.factors.data[unknown * gParams.elements + element] =
        (side & 1u) == 0u ? factor : -factor;
  }
}
