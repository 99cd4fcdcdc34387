// restir_gi: how many donors over space there are. Known without samples: any number is unbiased.

// How many a slot wants of which `other` could be one: young histories more. An old one is hurt by
// what differs from it in every sample, as two pixels at an outline do.
RL_FN uint giDonors(uint slot, uint other) {
  if (giAge(slot) <= gParams.youngFrames) return gParams.spatialNeighbours;
  return cacheIsOutline(slot) || cacheIsOutline(other) ? 0u : gParams.agedNeighbours;
}

// No slot of this frame has more: in a still view there comes a frame in which none is young.
RL_FN uint giMostDonors() {
  return gFrame.stillFrames >= gParams.settledFrames ? gParams.agedNeighbours
                                                     : gParams.spatialNeighbours;
}
