// Pass: looks up the entry of each query.
#include "core/caches/entries/lookup.glsl"

RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint query = entryQuery(at);
  if (query != RL_INVALID) entryLook(query);
}
