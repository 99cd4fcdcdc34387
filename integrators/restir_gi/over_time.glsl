// Included once per payload, with RL_RESERVOIR defined, by the temporal pass.

// Merges the last frame's reservoir of the same surface into this frame's, in place. `r` only tells
// which.
RL_FN void giReuseOverTime(uint slot, RL_IN(Anchor) here, uint donorSlot, RL_IN(Anchor) there,
                           real u, RL_INOUT(RL_RESERVOIR) r) {
  RL_RESERVOIR donor;
  cacheReadStateNow(slot, r);
  cacheReadStateBefore(donorSlot, donor);
  real cDonor = giCappedConfidence(donor.state.confidence);
  if (giIsEmpty(r.state) && giIsEmpty(donor.state)) {
    r.state.confidence += cDonor;
    cacheWriteStateNow(slot, r);
    return;
  }
  uint flags = gParams.temporalFlags;
  Shifted ours = mergeUnshifted(r.state);
  Shifted theirs = mergeUnshifted(donor.state);
  if (!bridgeIsSameAnchor(here, there)) {
    cacheReadNow(slot, r);
    cacheReadBefore(donorSlot, donor);
    ours = reuseShift(r, here, there, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
    theirs = reuseShift(donor, there, here, (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u);
  }
  MergeState merge = mergeBegin(r.state, cDonor);
  mergeWeighCanonical(merge, r.state, cDonor, ours, flags);
  mergeCanonical(merge, r.state, flags);
  vec3 ratio = bridgeReflectanceRatio(there, here);
  bool won = mergeDonor(merge, r.state, donor.state, cDonor, theirs, ratio, flags, u);
  mergeEnd(merge, r.state, flags);
  if (won) {
    cacheReadBefore(donorSlot, donor);
    donor.state = r.state;
    cacheWriteNow(slot, donor);
  } else {
    cacheWriteStateNow(slot, r);
  }
}

// The slot's sample as its partners see it: each shift serves both merges of a pair.
RL_FN void giShiftToPartner(uint slot, RL_IN(Anchor) here, uint k, RL_IN(Anchor) there,
                            RL_INOUT(RL_RESERVOIR) r) {
  cacheReadNow(slot, r);
  cacheWriteShifted(cacheExchangeIndex(slot, k), r, reuseShift(r, here, there, false));
}
