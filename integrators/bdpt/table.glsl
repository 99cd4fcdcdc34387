// Makes the table of bdpt.h from its blocks, in one thread: lamps, suns and the sky get equal
// shares; a sixteenth goes to all blocks alike, whatever their lights are thought to send.

RL_FN void kernelMain(RL_IN(uvec2) entry) {
  if (entry.x != 0u || entry.y != 0u) return;
  float lamps = 0.0f;
  float suns = 0.0f;
  float shining = 0.0f;
  float brightest = 0.0f;
  vec3 low = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  vec3 high = -low;
  for (uint i = 0u; i < RL_BDPT_BLOCKS; i = i + 1u) {
    uint at = i * RL_BDPT_BLOCK_FLOATS;
    float lamp = gBuffers.blocks.data[at];
    float sun = gBuffers.blocks.data[at + 1u];
    lamps += lamp;
    suns += sun;
    if (lamp > 0.0f || sun > 0.0f) shining += 1.0f;
    low = min(low, vec3(gBuffers.blocks.data[at + 2u], gBuffers.blocks.data[at + 3u],
                        gBuffers.blocks.data[at + 4u]));
    high = max(high, vec3(gBuffers.blocks.data[at + 5u], gBuffers.blocks.data[at + 6u],
                          gBuffers.blocks.data[at + 7u]));
    brightest = max(brightest, gBuffers.blocks.data[at + 8u]);
  }
  vec3 centre = (low + high) * 0.5f;
  vec3 corner = (high - low) * 0.5f;
  float radius = sqrt(dot(corner, corner)) * 1.125f;
  if (!(low.x <= high.x)) {
    centre = vec3(0.0f, 0.0f, 0.0f);
    radius = 0.0f;
  }
  if (radius > 0.0f) brightest = max(brightest, lamps / (4.0f * RL_PI * radius * radius));
  bool hasSky = gScene.environmentLight != RL_INVALID;
  float kinds = (lamps > 0.0f ? 1.0f : 0.0f) + (suns > 0.0f ? 1.0f : 0.0f);
  float sky = hasSky ? 1.0f / (kinds + 1.0f) : 0.0f;
  gBuffers.table.data[0u] = floatBitsToUint(centre.x);
  gBuffers.table.data[1u] = floatBitsToUint(centre.y);
  gBuffers.table.data[2u] = floatBitsToUint(centre.z);
  gBuffers.table.data[3u] = floatBitsToUint(radius);
  gBuffers.table.data[RL_BDPT_TABLE_BRIGHTEST] = floatBitsToUint(brightest);
  gBuffers.table.data[RL_BDPT_TABLE_SKY] = floatBitsToUint(sky);
  gBuffers.table.data[RL_BDPT_TABLE_PER_BLOCK] =
      (gScene.lightCount + RL_BDPT_BLOCKS - 1u) / RL_BDPT_BLOCKS;
  float sum = 0.0f;
  uint last = 0u;
  for (uint i = 0u; i < RL_BDPT_BLOCKS; i = i + 1u) {
    float lamp = gBuffers.blocks.data[i * RL_BDPT_BLOCK_FLOATS];
    float sun = gBuffers.blocks.data[i * RL_BDPT_BLOCK_FLOATS + 1u];
    float share = 0.0f;
    if (lamp > 0.0f || sun > 0.0f) {
      share = (rlSafeDivide(lamp, lamps) + rlSafeDivide(sun, suns)) * (0.9375f / kinds) +
              0.0625f / shining;
      last = i;
    }
    sum += share;
    // In units of 2^-24: a block of little weight keeps a whole number of them.
    uint bound = uint(min(sum, 1.0f) * 16777215.0f) << 8u;
    gBuffers.table.data[RL_BDPT_TABLE_BOUNDS + i] = bound;
  }
  for (uint i = last; i < RL_BDPT_BLOCKS; i = i + 1u)
    gBuffers.table.data[RL_BDPT_TABLE_BOUNDS + i] = kinds > 0.0f ? 0xffffffffu : 0u;
}
