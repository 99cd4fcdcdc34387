// restir_gi: histories of light that is no more. One pixel of each group traces its path of the
// last frame again, with that frame's camera and random numbers: it finds what it found, but for
// rounding, or the light of the scene has changed. So noise is never taken for a change, and a
// still light changes no bit of an image. Beside a change histories are shortened by what few paths
// found, which is biased for as long as they are young (temporal gradients: Schied, Peters and
// Dachsbacher, "Gradient Estimation for Real-Time Adaptive Temporal Filtering", 2018).

// The share of a pixel's history that is kept in this frame.
RL_FN float giKept(uint slot) {
  if (gParams.change.every == 0u) return 1.0f;
  uint group = groupOfSlot(slot, gParams.change.every);
  float change = uintBitsToFloat(gBuffers.changes.data[group]);
  return max(1.0f - gParams.change.response * change, 0.0f);
}

// Of which frame and settings a path is: others would draw other samples.
RL_FN uint giReplayTag(uint frame) {
  return rngHash(frame ^ rngHash(gParams.change.every * 65536u + gParams.path.lightCandidates));
}

// What the pixel whose turn it is has found, to be compared with in the next frame.
RL_FN void giRemember(uint slot, float luminance) {
  if (gParams.change.every == 0u) return;
  uint group = groupOfSlot(slot, gParams.change.every);
  if (groupOfferer(group, gParams.change.every) != slot) return;
  gBuffers.found.data[2u * group] = rlIsFinite(luminance) ? floatBitsToUint(luminance) : 0u;
  gBuffers.found.data[2u * group + 1u] = giReplayTag(gFrame.frame);
}

RL_FN float giLuminance(RL_IN(PathGather) p, RL_IN(PathReservoir) r) {
  return rlLuminance(r.state.F * r.state.W + r.state.residual + p.ownLight + p.inView);
}
