// A loop in a loop, and one after both.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint index = pixel.y * gFrame.width + pixel.x;
  uint state = index;
  uint turned = 0u;
  for (uint i = 0u; i < gParams.outer; i = i + 1u) {
    for (uint j = 0u; j < gParams.inner; j = j + 1u) {
      state = rngHash(state);
      turned = turned + 1u;
    }
  }
  gBuffers.turned.data[index] = turned;
  gBuffers.states.data[index] = state;
}
