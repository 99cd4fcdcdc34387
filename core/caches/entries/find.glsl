// Pass: looks up the entry of each asker (query).
#include "core/caches/entries/look.glsl"

RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint asker = entryAsker(at);
  if (asker != RL_INVALID) entryLook(asker);
}
