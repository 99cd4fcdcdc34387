// Pass over groups of pixels: computes the share of the light that has changed, over the groups
// beside each one and some rows above and below, because few paths carry the light of any one lamp.
RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  uint every = gParams.changes.every;
  uint pixels = gFrame.width * gFrame.height;
  if (every == 0u || group * every >= pixels) return;
  uvec2 at = pixelOfIndex(min(group * every + every / 2u, pixels - 1u));
  float difference = 0.0f;
  float greater = 0.0f;
  for (uint i = 0u; i < 3u * (2u * RL_CHANGE_ROWS + 1u); i = i + 1u) {
    // Left of column 0 and above row 0 the index wraps to a large number: outside, too.
    uint x = at.x + (i % 3u) * every - every;
    uint y = at.y + i / 3u - RL_CHANGE_ROWS;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    uint other = (y * gFrame.width + x) / every;
    difference += uintBitsToFloat(gBuffers.differences.data[2u * other]);
    greater += uintBitsToFloat(gBuffers.differences.data[2u * other + 1u]);
  }
  gBuffers.changes.data[group] = floatBitsToUint(rlSafeDivide(difference, greater));
}
