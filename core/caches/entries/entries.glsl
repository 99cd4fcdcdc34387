// Functions by which integrators read caches in world space.
#include "core/caches/entries/anchor.glsl"
#include "core/caches/entries/groups.glsl"

RL_FN uint entryGroup(uint slot) { return groupOfSlot(slot, gParams.entries.feedEvery); }
RL_FN uint entryOfferer(uint group) { return groupOfferer(group, gParams.entries.feedEvery); }
