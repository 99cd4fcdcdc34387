// Selects which pixels insert their sample into an entry. Adjacent pixels form groups; each frame
// one pixel of a group inserts, round robin. An entry takes the candidates of the groups with the
// greatest priorities, which do not depend on execution order.

RL_FN uint groupOfPixel(uint pixelIndex, uint every) { return pixelIndex / every; }
// Pixel of a group that inserts in a frame. The last group may have fewer pixels.
RL_FN uint groupRoundRobin(uint group, uint every, uint frame) {
  uint first = group * every;
  uint size = min(every, gFrame.width * gFrame.height - first);
  return first + (rngHash(group) % size + frame % size) % size;
}
RL_FN uint groupCandidatePixel(uint group, uint every) {
  return groupRoundRobin(group, every, gFrame.frame);
}

// Priority of a group or pixel: unique, in an order that changes from frame to frame. 0
// for one of 2^32 indices, which then waits a frame.
RL_FN uint entryPriority(uint index) {
  return (index + rngSharedBits(0u, RL_DIM_DONOR_U)) * 2654435761u;
}
RL_FN uint groupOfPriority(uint priority) {
  return priority * 244002641u - rngSharedBits(0u, RL_DIM_DONOR_U);
}

// Inserts a group into an entry. The entry takes the greatest priority of each of
// RL_ENTRY_INSERTIONS buckets.
RL_FN void groupInserts(RL_IN(UintRef) insertions, uint entry, uint group) {
  uint priority = entryPriority(group);
  uint bucket = rngHash(priority) % RL_ENTRY_INSERTIONS;
  RL_ATOMIC_MAX(insertions, entry * RL_ENTRY_INSERTIONS + bucket, priority);
}
