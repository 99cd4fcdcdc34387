// restir_gi: histories of light that is no more. One pixel of each group traces its path of the
// last frame again, with that frame's camera and random numbers: it finds what it found, but for
// rounding, or the light of the scene has changed. So noise is never taken for a change, and a
// still light changes no bit of an image. Beside a change histories are shortened by what few paths
// found, which is biased for as long as they are young (temporal gradients: Schied, Peters and
// Dachsbacher, "Gradient Estimation for Real-Time Adaptive Temporal Filtering", 2018).

RL_FN float giKeptOf(float change) { return max(1.0f - gParams.change.response * change, 0.0f); }
// The share of a pixel's history that is kept in this frame.
RL_FN float giKept(uint slot) {
  if (gParams.change.every == 0u) return 1.0f;
  uint group = groupOfSlot(slot, gParams.change.every);
  return giKeptOf(uintBitsToFloat(gBuffers.changes.data[group]));
}
// The share that an entry keeps which nobody feeds: what it lies beside is not in view, so it goes
// by the mean over the image, of which it looks at some places.
RL_FN float giKeptOutOfView(uint entry) {
  uint every = gParams.change.every;
  if (every == 0u) return 1.0f;
  uint groups = (gFrame.width * gFrame.height + every - 1u) / every;
  Rng rng = rngInit(gFrame.seed, entry, gFrame.frame);
  rng.vertex = RL_VERTEX_FEED;
  uint first = rngBits(rng, RL_DIM_DONOR_U) % groups;
  float change = 0.0f;
  for (uint i = 0u; i < RL_GI_CHANGE_PLACES; i = i + 1u) {
    uint group = (first + i * (groups / RL_GI_CHANGE_PLACES)) % groups;
    change += uintBitsToFloat(gBuffers.changes.data[group]);
  }
  return giKeptOf(change / float(RL_GI_CHANGE_PLACES));
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
