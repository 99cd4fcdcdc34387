// Functions by which integrators read caches in world space.
#include "core/caches/entries/shading_point.glsl"
#include "core/caches/entries/groups.glsl"

RL_FN uint entryGroup(uint pixelIndex) {
  return groupOfPixel(pixelIndex, gParams.entries.insertEvery);
}
RL_FN uint entryCandidatePixel(uint group) {
  return groupCandidatePixel(group, gParams.entries.insertEvery);
}
