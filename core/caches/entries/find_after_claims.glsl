// Pass: queries without an entry look again, after others have claimed hash slots.
#include "core/caches/entries/lookup.glsl"

RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint query = entryQuery(at);
  if (query != RL_INVALID && gBuffers.entries.data[query] >= RL_GRID_CLAIM) entryLook(query);
}
