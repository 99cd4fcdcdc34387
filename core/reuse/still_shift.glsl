// Shift over time in a still view: the identity, for every surface and path. Both samples are of
// one pixel, with one target, so that MIS weights by confidence are exact. Traces nothing.

RL_FN bool temporalIsStill() { return true; }

RL_FN void temporalShift(RL_INOUT(TemporalMerge) t, RL_IN(RL_RESERVOIR) here,
                         RL_IN(RL_RESERVOIR) donor, uint pixelIndex, uint previousPixel) {
  t.canonicalAtNeighbour = mergeUnshifted(here.state);
  t.neighbourAtCanonical = mergeUnshifted(donor.state);
  t.ratio = vec3(1.0f, 1.0f, 1.0f);
}
