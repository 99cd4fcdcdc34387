// What caches share. A cache says where reservoirs live and who serves whom as a donor:
// - cacheSlot(pixel): my slot;
// - cacheDonorOverTime(slot, donor): the slot that held my surface in the last frame; false where
// it
//   was not seen. In a still view it is my own;
// - cachePartner(pixel, k, partner): my k-th donor over space, whose k-th donor I am; or false.
// Their answers depend on what pixels show at their centres and on the frame's number alone: an
// answer that knew the samples would bias what it lets through.

// Two surfaces are alike enough to exchange samples. Symmetric.
RL_FN bool cacheSurfacesMatch(RL_IN(VisibleSurface) a, RL_IN(VisibleSurface) b) {
  if (a.isHit == 0u || b.isHit == 0u) return false;
  vec3 camera = gFrame.camera.posW;
  float distanceToCamera = max(distance(camera, a.posW), distance(camera, b.posW));
  return visibleMatch(a, b, distanceToCamera, gParams.cache.minNormalDot,
                      gParams.cache.maxPlaneDistance);
}
