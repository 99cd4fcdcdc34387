// Many pixels write the same words.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint index = pixel.y * gFrame.width + pixel.x;
  uint hash = rngHash(index);
  uint bin = hash % gParams.bins;
  RL_ATOMIC_ADD(gBuffers.counts, bin, 1u);
  RL_ATOMIC_MAX(gBuffers.greatest, bin, hash);
  uint before = RL_ATOMIC_CAS(gBuffers.claims, bin, RL_INVALID, index);
  gBuffers.claimed.data[index] = before == RL_INVALID ? 1u : 0u;
}
