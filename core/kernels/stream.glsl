// stream: copies a buffer. The words of a tile of 8 x 8 pixels lie together, those of side by side
// pixels side by side.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint tile = (pixel.y / 8u) * (gFrame.width / 8u) + pixel.x / 8u;
  uint first = tile * 64u * RL_STREAM_WORDS + (pixel.y % 8u) * 8u + pixel.x % 8u;
  for (uint i = 0u; i < RL_STREAM_WORDS; i = i + 1u) {
    gBuffers.to.data[first + i * 64u] = gBuffers.from.data[first + i * 64u];
  }
}
