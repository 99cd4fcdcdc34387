// stream: copies a buffer. The uvec4s of a tile of 8 x 8 pixels lie together; the i-th uvec4s of
// adjacent pixels are adjacent, too.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint tile = (pixel.y / 8u) * (gFrame.width / 8u) + pixel.x / 8u;
  uint first = tile * 64u * RL_STREAM_UVEC4S + (pixel.y % 8u) * 8u + pixel.x % 8u;
  for (uint i = 0u; i < RL_STREAM_UVEC4S; i = i + 1u) {
    uint at = first + i * 64u;
    RL_WRITE_UVEC4(gBuffers.to, at, RL_EARLIER_UVEC4(gBuffers.from, at));
  }
}
