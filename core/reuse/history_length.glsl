// The length of histories: their age, in frames; and the words of UnresampledCount.

// Number of frames of this view that a history averages, this one included. After a camera move a
// history counts as one frame: light that the pixel did not see from the old position is known from
// this frame alone, which decides the error. Neighbours may have seen that light.
RL_FN float historyAge() {
  if (gParams.reuse.temporalReuse == 0u) return 1.0f;
  return min(float(gFrame.stillFrames), gParams.reuse.confidenceCap) + 1.0f;
}

// Upper bound of the number of frames that the radiance of a reservoir averages, this one included.
// A part of its confidence comes from the same pixel in the last frame: at most the cap of a
// temporal donor, which is what is assumed. The rest is new, or comes from other pixels. An average
// that renews a share s of itself averages 1 / s frames.
RL_FN float radianceFrames(float confidence) {
  if (!(confidence > 1.0f)) return 1.0f;
  float cap = gParams.reuse.reproject != 0u ? gParams.reuse.movingConfidenceCap : 0.0f;
  if (viewIsStill()) cap = gParams.reuse.confidenceCap;
  if (gParams.reuse.temporalReuse == 0u) cap = 0.0f;
  return confidence / max(confidence - min(cap, confidence - 1.0f), 1.0f);
}

// Number of samples in a pixel's unresampled light, packed into the last word of its record.
RL_FN UnresampledCount unresampledCountUnpack(uint word) {
  UnresampledCount count;
  count.taken = word & 0xffu;
  count.level = (word >> 8u) & 0xffu;
  count.frames = word >> 16u;
  return count;
}
RL_FN uint unresampledCountPack(RL_IN(UnresampledCount) count) {
  return count.taken | (count.level << 8u) | (count.frames << 16u);
}

// Level of light in view, for UnresampledCount: the exponent of its luminance.
RL_FN uint levelOfLight(RL_IN(vec3) light) {
  return (floatBitsToUint(max(rlLuminance(light), 0.0f)) >> 23u) & 0xffu;
}
