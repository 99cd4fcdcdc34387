// restir_gi: the age of histories.

// How many frames of this view a history averages, this one included. A history that the camera has
// moved counts as one frame: what its pixel did not see from where it was, it knows from this frame
// alone, and that decides the error. Neighbours may have seen it.
RL_FN float giAge() {
  if (gParams.temporalReuse == 0u) return 1.0f;
  return min(float(gFrame.stillFrames), gParams.confidenceCap) + 1.0f;
}
