// Empties the sums of splats.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint first = pixelIndexOf(pixel) * RL_BDPT_SPLAT_WORDS;
  for (uint i = 0u; i < RL_BDPT_SPLAT_WORDS; i = i + 1u) gBuffers.splats.data[first + i] = 0u;
}
