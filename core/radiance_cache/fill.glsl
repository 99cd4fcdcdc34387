// Pass over cells: adds the light of the insertions to the mean, in the order of their lots, which
// does not depend on execution order. In the frame of its validation a cell keeps the brightest of
// the insertions' paths: a path that found no light would notice no change.
#include "core/caches/entries/groups.glsl"
#include "core/radiance_cache/round_robin.glsl"

RL_FN void radianceKeep(uint cell, uint group, RL_IN(vec3) light) {
  uint ray = group * RL_RADIANCE_RAY_UVEC4S;
  uvec4 to = RL_EARLIER_UVEC4(gBuffers.cells.rays, ray + 1u);
  to.w = gFrame.frame;
  uint at = cell * RL_RADIANCE_KEPT_UVEC4S;
  RL_WRITE_UVEC4(gBuffers.kept, at, RL_EARLIER_UVEC4(gBuffers.cells.rays, ray));
  RL_WRITE_UVEC4(gBuffers.kept, at + 1u, to);
  RL_WRITE_UVEC4(gBuffers.kept, at + 2u, recordUvec4(light, group));
}

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint cell = row.y * RL_ENTRY_ROW + row.x;
  if (cell >= gParams.entries.count) return;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  vec3 brightest = sum;
  uint brightestGroup = RL_INVALID;
  float count = 0.0f;
  for (uint i = 0u; i < RL_ENTRY_INSERTIONS; i = i + 1u) {
    uint priority = gBuffers.insertions.data[cell * RL_ENTRY_INSERTIONS + i];
    if (priority == 0u) continue;
    uint group = groupOfPriority(priority);
    vec3 light =
        recordVec3(RL_EARLIER_UVEC4(gBuffers.points, group * RL_RADIANCE_POINT_UVEC4S + 1u));
    sum += light;
    count += 1.0f;
    if (rlMax3(light) > rlMax3(brightest)) {
      brightest = light;
      brightestGroup = group;
    }
  }
  if (count == 0.0f) return;
  uvec4 past = RL_EARLIER_UVEC4(gBuffers.cells.light, cell);
  float before = min(uintBitsToFloat(past.w), gParams.entries.cap - count);
  vec3 mean = (recordVec3(past) * before + sum) * (1.0f / (before + count));
  RL_WRITE_UVEC4(gBuffers.cells.light, cell, recordUvec4(mean, floatBitsToUint(before + count)));
  if (brightestGroup == RL_INVALID) return;
  bool keepsNone = RL_EARLIER_UVEC4(gBuffers.kept, cell * RL_RADIANCE_KEPT_UVEC4S).w == 0u;
  if (keepsNone || radianceIsDue(cell)) radianceKeep(cell, brightestGroup, brightest);
}
