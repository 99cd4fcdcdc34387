// Share of a history that is kept if light has changed. Near a change, histories are shortened by
// the results of few paths, which is biased for as long as the histories are young.

RL_FN float changeWeightOfShare(RL_IN(ChangeParams) params, float change) {
  return max(1.0f - params.response * change, 0.0f);
}
// The share of a pixel's history that is kept in this frame.
RL_FN float changeHistoryKept(RL_IN(UintRef) changes, RL_IN(ChangeParams) params, uint pixelIndex) {
  if (params.every == 0u) return 1.0f;
  return changeWeightOfShare(params, uintBitsToFloat(changes.data[pixelIndex / params.every]));
}
// Share that is kept of a history of surfaces out of view: by the mean change over the image, at
// RL_CHANGE_PLACES places.
RL_FN float changeHistoryKeptOutOfView(RL_IN(UintRef) changes, RL_IN(ChangeParams) params,
                                       RL_IN(Rng) rng) {
  if (params.every == 0u) return 1.0f;
  uint groups = (gFrame.width * gFrame.height + params.every - 1u) / params.every;
  uint first = rngBits(rng, RL_DIM_DONOR_U) % groups;
  float change = 0.0f;
  for (uint i = 0u; i < RL_CHANGE_PLACES; i = i + 1u) {
    uint group = (first + i * (groups / RL_CHANGE_PLACES)) % groups;
    change += uintBitsToFloat(changes.data[group]);
  }
  return changeWeightOfShare(params, change / float(RL_CHANGE_PLACES));
}
