// A cache answers five questions for the reuse loop:
// - cacheSlot(pixel): my slot;
// - cacheDonorOverTime(here, slot): where my surface was last frame; false where it was not seen;
// - cachePartner(pixel, here, k, slot): my k-th donor over space, whose k-th donor I am; or false;
// - cacheAnchorNow, cacheAnchorBefore, cacheWriteAnchor: the surface at which a slot's sample is
//   evaluated, in this frame and in the last;
// - cacheReadNow, cacheReadBefore, cacheWriteNow, cacheWriteHistory: a slot's reservoirs,
// overloaded
//   by type.
// Which file answers is the `cache` of a run; this one holds what they share.

// Two anchors are similar enough to exchange samples. Symmetric, and blind to the samples:
// confidences that depended on samples would bias the result.
RL_FN bool cacheAnchorsMatch(RL_IN(Anchor) a, RL_IN(Anchor) b, float distanceToCamera) {
  if (a.isReusable == 0u || b.isReusable == 0u) return false;
  if (dot(a.nShadeW, b.nShadeW) < gParams.minNormalDot) return false;
  vec3 d = b.posW - a.posW;
  float planeDistance = max(abs(dot(d, a.nGeoW)), abs(dot(d, b.nGeoW)));
  return planeDistance <= gParams.maxPlaneDistance * distanceToCamera;
}
