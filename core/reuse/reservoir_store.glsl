// Storage of reservoirs: this frame's (initial, then merged over time, or by a round over space),
// the last frame's, and those of entries. Reads are of earlier passes' data (RL_EARLIER_UVEC4): no
// pass reads its own writes.

RL_FN RL_RESERVOIR reservoirReadNow(uint pixelIndex) {
  return sampleRead(gBuffers.reservoirs, pixelIndex);
}
RL_FN RL_RESERVOIR reservoirReadPrevious(uint pixelIndex) {
  return sampleRead(gBuffers.history, pixelIndex);
}
RL_FN void reservoirWriteNow(uint pixelIndex, RL_IN(RL_RESERVOIR) r) {
  sampleWrite(gBuffers.reservoirs, pixelIndex, r);
}
RL_FN void reservoirWriteHistory(uint pixelIndex, RL_IN(RL_RESERVOIR) r) {
  sampleWrite(gBuffers.history, pixelIndex, r);
}

// States are read on their own: merges decide by states, and only the winner's sample is moved.
RL_FN ReservoirState stateReadNow(uint pixelIndex) {
  return sampleStateRead(gBuffers.reservoirs, pixelIndex);
}
RL_FN ReservoirState stateReadPrevious(uint pixelIndex) {
  return sampleStateRead(gBuffers.history, pixelIndex);
}
RL_FN void stateWriteNow(uint pixelIndex, RL_IN(RL_RESERVOIR) r) {
  sampleStateWrite(gBuffers.reservoirs, pixelIndex, r);
}
// Copies the path of another reservoir. The merge has set the state of r already.
RL_FN void takeSampleNow(uint pixelIndex, RL_INOUT(RL_RESERVOIR) r) {
  sampleCopyPath(r, reservoirReadNow(pixelIndex));
}
RL_FN void takeSamplePrevious(uint pixelIndex, RL_INOUT(RL_RESERVOIR) r) {
  sampleCopyPath(r, reservoirReadPrevious(pixelIndex));
}

// Reservoirs of entries.
RL_FN RL_RESERVOIR entryReservoirRead(uint entry) {
  return sampleRead(gBuffers.entryReservoirs, entry);
}
RL_FN ReservoirState entryStateRead(uint entry) {
  return sampleStateRead(gBuffers.entryReservoirs, entry);
}
RL_FN void takeEntrySample(uint entry, RL_INOUT(RL_RESERVOIR) r) {
  sampleCopyPath(r, entryReservoirRead(entry));
}
RL_FN void entryReservoirWrite(uint entry, RL_IN(RL_RESERVOIR) r) {
  sampleWrite(gBuffers.entryReservoirs, entry, r);
}

// Reads the candidate of a pixel for its entry: the sample that it found in this frame alone.
// Before the temporal pass that is the pixel's reservoir. In a still view the initial pass has
// merged the history already: it leaves the candidate in the history's place, which the spatial
// pass fills again.
RL_FN RL_RESERVOIR candidateRead(uint pixelIndex) {
  if (viewIsStill()) return reservoirReadPrevious(pixelIndex);
  return reservoirReadNow(pixelIndex);
}
RL_FN ReservoirState candidateStateRead(uint pixelIndex) {
  if (viewIsStill()) return stateReadPrevious(pixelIndex);
  return stateReadNow(pixelIndex);
}
RL_FN void takeCandidateSample(uint pixelIndex, RL_INOUT(RL_RESERVOIR) r) {
  sampleCopyPath(r, candidateRead(pixelIndex));
}

// Pixels' samples shifted to their k-th neighbours.
RL_FN Uvec4Ref pairedShifts(uint k) {
  Uvec4Ref shifts = gBuffers.pairedShifts0;
  if (k == 1u) shifts = gBuffers.pairedShifts1;
  if (k == 2u) shifts = gBuffers.pairedShifts2;
  if (k == 3u) shifts = gBuffers.pairedShifts3;
  return shifts;
}
