// Storage of restir_gi's reservoirs: this frame's (initial, then merged over time) and the last
// frame's. Reads are of earlier passes' data (RL_PAST_QUAD): no pass reads its own writes.

RL_FN void giRead(RL_IN(QuadRef) quads, RL_IN(QuadRef) suffixes, uint slot,
                  RL_INOUT(PathReservoir) r) {
  pathReservoirRead(quads, slot * RL_PATH_RESERVOIR_QUADS, r);
  if (RL_HAS(RL_FEATURE_GLOSSY))
    r.path.suffix = pathSuffixRead(suffixes, slot * RL_PATH_SUFFIX_QUADS);
}
RL_FN void giWrite(RL_IN(QuadRef) quads, RL_IN(QuadRef) suffixes, uint slot,
                   RL_IN(PathReservoir) r) {
  pathReservoirWrite(quads, slot * RL_PATH_RESERVOIR_QUADS, r);
  if (RL_HAS(RL_FEATURE_GLOSSY))
    pathSuffixWrite(suffixes, slot * RL_PATH_SUFFIX_QUADS, r.path.suffix);
}

RL_FN void giReadNow(uint slot, RL_INOUT(PathReservoir) r) {
  giRead(gBuffers.reservoirs, gBuffers.suffixes, slot, r);
}
RL_FN void giReadBefore(uint slot, RL_INOUT(PathReservoir) r) {
  giRead(gBuffers.history, gBuffers.suffixesHistory, slot, r);
}
RL_FN void giWriteNow(uint slot, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.reservoirs, gBuffers.suffixes, slot, r);
}
RL_FN void giWriteHistory(uint slot, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.history, gBuffers.suffixesHistory, slot, r);
}

// States are read on their own: merges decide by states, and only the winner's path is moved.
RL_FN ReservoirState giReadStateNow(uint slot) {
  return pathStateRead(gBuffers.reservoirs, slot * RL_PATH_RESERVOIR_QUADS);
}
RL_FN ReservoirState giReadStateBefore(uint slot) {
  return pathStateRead(gBuffers.history, slot * RL_PATH_RESERVOIR_QUADS);
}
RL_FN void giWriteStateNow(uint slot, RL_IN(PathReservoir) r) {
  pathStateWrite(gBuffers.reservoirs, slot * RL_PATH_RESERVOIR_QUADS, r);
}
// Replaces the path by the one of another reservoir, under the selected state.
RL_FN void giTakePathNow(uint slot, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadNow(slot, from);
  r.path = from.path;
}
RL_FN void giTakePathBefore(uint slot, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadBefore(slot, from);
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
// history already: the offer then takes the history's place, which the spatial pass fills again.
RL_FN void giReadOffer(uint slot, RL_INOUT(PathReservoir) r) {
  if (gFrame.stillFrames == 0u) {
    giReadNow(slot, r);
  } else {
    giReadBefore(slot, r);
  }
}
RL_FN ReservoirState giReadOfferState(uint slot) {
  if (gFrame.stillFrames == 0u) return giReadStateNow(slot);
  return giReadStateBefore(slot);
}
RL_FN void giTakeOfferPath(uint slot, RL_INOUT(PathReservoir) r) {
  PathReservoir from = r;
  giReadOffer(slot, from);
  r.path = from.path;
}

// Index in the exchange buffer of a slot's sample shifted to its k-th partner.
RL_FN uint giExchangeIndex(uint slot, uint k) { return slot * gParams.spatialNeighbours + k; }
