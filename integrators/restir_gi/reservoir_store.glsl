// Storage of restir_gi's reservoirs: this frame's (initial, then merged over time) and the last
// frame's. Reads are of earlier passes' data (RL_PAST_QUAD): no pass reads its own writes.

RL_FN void giRead(RL_IN(QuadRef) quads, RL_IN(QuadRef) suffixes, uint pixelIndex,
                  RL_INOUT(PathReservoir) r) {
  pathReservoirRead(quads, pixelIndex * RL_PATH_RESERVOIR_QUADS, r);
  if (RL_HAS(RL_FEATURE_GLOSSY))
    r.path.suffix = pathSuffixRead(suffixes, pixelIndex * RL_PATH_SUFFIX_QUADS);
}
RL_FN void giWrite(RL_IN(QuadRef) quads, RL_IN(QuadRef) suffixes, uint pixelIndex,
                   RL_IN(PathReservoir) r) {
  pathReservoirWrite(quads, pixelIndex * RL_PATH_RESERVOIR_QUADS, r);
  if (RL_HAS(RL_FEATURE_GLOSSY))
    pathSuffixWrite(suffixes, pixelIndex * RL_PATH_SUFFIX_QUADS, r.path.suffix);
}

RL_FN void giReadNow(uint pixelIndex, RL_INOUT(PathReservoir) r) {
  giRead(gBuffers.reservoirs, gBuffers.suffixes, pixelIndex, r);
}
RL_FN void giReadBefore(uint pixelIndex, RL_INOUT(PathReservoir) r) {
  giRead(gBuffers.history, gBuffers.suffixesHistory, pixelIndex, r);
}
RL_FN void giWriteNow(uint pixelIndex, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.reservoirs, gBuffers.suffixes, pixelIndex, r);
}
RL_FN void giWriteHistory(uint pixelIndex, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.history, gBuffers.suffixesHistory, pixelIndex, r);
}

// States are read on their own: merges decide by states, and only the winner's path is moved.
RL_FN ReservoirState giReadStateNow(uint pixelIndex) {
  return pathStateRead(gBuffers.reservoirs, pixelIndex * RL_PATH_RESERVOIR_QUADS);
}
RL_FN ReservoirState giReadStateBefore(uint pixelIndex) {
  return pathStateRead(gBuffers.history, pixelIndex * RL_PATH_RESERVOIR_QUADS);
}
RL_FN void giWriteStateNow(uint pixelIndex, RL_IN(PathReservoir) r) {
  pathStateWrite(gBuffers.reservoirs, pixelIndex * RL_PATH_RESERVOIR_QUADS, r);
}
// Replaces the path by the one of another reservoir, under the selected state.
RL_FN void giTakePathNow(uint pixelIndex, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadNow(pixelIndex, from);
  r.path = from.path;
}
RL_FN void giTakePathBefore(uint pixelIndex, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadBefore(pixelIndex, from);
  r.path = from.path;
}

// Reservoirs of entries.
RL_FN void giReadEntry(uint entry, RL_INOUT(PathReservoir) r) {
  giRead(gBuffers.entryReservoirs, gBuffers.entrySuffixes, entry, r);
}
RL_FN ReservoirState giReadEntryState(uint entry) {
  return pathStateRead(gBuffers.entryReservoirs, entry * RL_PATH_RESERVOIR_QUADS);
}
RL_FN void giTakeEntryPath(uint entry, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadEntry(entry, from);
  r.path = from.path;
}
RL_FN void giWriteEntry(uint entry, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.entryReservoirs, gBuffers.entrySuffixes, entry, r);
}

// Reads the sample that a pixel offers to its entry: the one it found in this frame alone. Before
// the temporal pass that is the pixel's reservoir. In a still view the initial pass has merged the
// history already: the candidate then takes the history's place, which the spatial pass fills
// again.
RL_FN void giReadCandidate(uint pixelIndex, RL_INOUT(PathReservoir) r) {
  if (gFrame.stillFrames == 0u) {
    giReadNow(pixelIndex, r);
  } else {
    giReadBefore(pixelIndex, r);
  }
}
RL_FN ReservoirState giReadCandidateState(uint pixelIndex) {
  if (gFrame.stillFrames == 0u) return giReadStateNow(pixelIndex);
  return giReadStateBefore(pixelIndex);
}
RL_FN void giTakeCandidatePath(uint pixelIndex, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadCandidate(pixelIndex, from);
  r.path = from.path;
}

// Index in the paired_shift buffer of a pixel's sample shifted to its k-th neighbour.
RL_FN uint giPairedShiftIndex(uint pixelIndex, uint k) {
  return pixelIndex * gParams.spatialNeighbours + k;
}
