// restir_gi: the age of histories.

// How many frames of this view a history averages, this one included. A history that the camera has
// moved counts as one frame: what its pixel did not see from where it was, it knows from this frame
// alone, and that decides the error. Neighbours may have seen it.
RL_FN float giAge() {
  if (gParams.temporalReuse == 0u) return 1.0f;
  return min(float(gFrame.stillFrames), gParams.confidenceCap) + 1.0f;
}

// Of a pixel's own light: the last word of its quad.
RL_FN GiOwnCount giOwnCount(uint word) {
  GiOwnCount count;
  count.taken = word & 0xffu;
  count.frames = word >> 8u;
  return count;
}
RL_FN uint giOwnWord(RL_IN(GiOwnCount) count) { return count.taken | (count.frames << 8u); }
