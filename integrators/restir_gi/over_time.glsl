// Included once per payload, with RL_RESERVOIR defined, by the temporal pass.

// The shift of a sample to an anchor, its shadow ray as segment `which`.
RL_FN Shifted giShift(RL_IN(RL_RESERVOIR) r, RL_IN(Anchor) from, RL_IN(Anchor) to,
                      bool assumeVisible, uint which, RL_INOUT(GiSegments) segments) {
  Shifted s = reuseShift(r, from, to);
  if (reuseAsksVisibility(s, assumeVisible)) {
    segments.rays[which] = bridgeSegment(r, to);
    segments.asks[which] = 1u;
  }
  return s;
}

// Reads the last frame's reservoir of the same surface, and shifts its sample and that of this
// frame each to the other's anchor. False where there is nothing to merge.
RL_FN bool giShiftOverTime(uint slot, RL_IN(Anchor) here, uint donorSlot, RL_IN(Anchor) there,
                           uint which, RL_INOUT(RL_RESERVOIR) r, RL_INOUT(RL_RESERVOIR) donor,
                           RL_INOUT(Shifted) ours, RL_INOUT(Shifted) theirs,
                           RL_INOUT(GiSegments) segments) {
  cacheReadBefore(donorSlot, donor);
  if (giIsEmpty(r.state) && giIsEmpty(donor.state)) {
    r.state.confidence += giCappedConfidence(donor.state.confidence);
    cacheWriteStateNow(slot, r);
    return false;
  }
  uint flags = gParams.temporalFlags;
  ours = mergeUnshifted(r.state);
  theirs = mergeUnshifted(donor.state);
  if (!bridgeIsSameAnchor(here, there)) {
    ours = giShift(r, here, there, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u, which, segments);
    theirs = giShift(donor, there, here, (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u, which + 1u,
                     segments);
  }
  return true;
}

// Merges them in place of this frame's, here and in the buffer. ours, theirs: the samples as the
// other anchor sees them.
RL_FN void giMergeOverTime(uint slot, RL_IN(Anchor) here, RL_IN(Anchor) there, real u,
                           RL_IN(Shifted) ours, RL_IN(Shifted) theirs, RL_INOUT(RL_RESERVOIR) r,
                           RL_INOUT(RL_RESERVOIR) donor) {
  uint flags = gParams.temporalFlags;
  real cDonor = giCappedConfidence(donor.state.confidence);
  MergeState merge = mergeBegin(r.state, cDonor);
  mergeWeighCanonical(merge, r.state, cDonor, ours, flags);
  mergeCanonical(merge, r.state, flags);
  vec3 ratio = bridgeReflectanceRatio(there, here);
  bool won = mergeDonor(merge, r.state, donor.state, cDonor, theirs, ratio, flags, u);
  mergeEnd(merge, r.state, flags);
  if (won) {
    donor.state = r.state;
    r = donor;
    cacheWriteNow(slot, r);
  } else {
    cacheWriteStateNow(slot, r);
  }
}
