// Included once per payload, with RL_RESERVOIR defined, by the spatial pass.

// Merges the partners' temporal reservoirs into the slot's, leaves the result in the history and
// returns what the pixel shows. `r` only tells which payload; donor k's draw has dimension + k.
RL_FN vec3 giReuseOverSpace(uint slot, RL_IN(Anchor) here, RL_IN(Rng) rng, uint dimension,
                            RL_INOUT(RL_RESERVOIR) r) {
  uint flags = gParams.spatialFlags;
  RL_RESERVOIR donor;
  cacheReadStateNow(slot, r);
  bool isEmpty = giIsEmpty(r.state);
  real cDonors = 0.0f;
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner = gBuffers.partners.data[cacheExchangeIndex(slot, k)];
    if (partner == RL_INVALID) continue;
    cacheReadStateNow(partner, donor);
    cDonors += donor.state.confidence;
    isEmpty = isEmpty && giIsEmpty(donor.state);
  }
  if (isEmpty) {
    r.state.confidence += cDonors;
    cacheWriteStateHistory(slot, r);
    return vec3(0.0f, 0.0f, 0.0f);
  }
  MergeState merge = mergeBegin(r.state, cDonors);
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner = gBuffers.partners.data[cacheExchangeIndex(slot, k)];
    if (partner == RL_INVALID) continue;
    cacheReadStateNow(partner, donor);
    Shifted ours;
    cacheReadShifted(cacheExchangeIndex(slot, k), r, ours);
    mergeWeighCanonical(merge, r.state, donor.state.confidence, ours, flags);
  }
  mergeCanonical(merge, r.state, flags);
  ReservoirState selected = r.state;
  uint winner = slot;
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner = gBuffers.partners.data[cacheExchangeIndex(slot, k)];
    if (partner == RL_INVALID) continue;
    cacheReadStateNow(partner, donor);
    Shifted theirs;
    cacheReadShifted(cacheExchangeIndex(partner, k), r, theirs);
    vec3 ratio = bridgeReflectanceRatio(cacheAnchorNow(partner), here);
    float u = rngDraw(rng, dimension + k);
    if (mergeDonor(merge, selected, donor.state, donor.state.confidence, theirs, ratio, flags, u))
      winner = partner;
  }
  mergeEnd(merge, selected, flags);
  cacheReadNow(winner, r);
  r.state = selected;
  cacheWriteHistory(slot, r);
  return merge.estimate;
}
