// stream: copies a buffer, side by side pixels side by side words.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixels = gFrame.width * gFrame.height;
  uint index = pixel.y * gFrame.width + pixel.x;
  for (uint i = 0u; i < RL_STREAM_WORDS; i = i + 1u) {
    gBuffers.to.data[i * pixels + index] = gBuffers.from.data[i * pixels + index];
  }
}
