// Pass: askers (queries) without an entry look again, after others have claimed hash slots.
#include "core/caches/entries/look.glsl"

RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint asker = entryAsker(at);
  if (asker != RL_INVALID && gBuffers.entries.data[asker] >= RL_GRID_CLAIM) entryLook(asker);
}
