// Which pixels offer what they found in a frame. Pixels lie in groups, side by side; each frame one
// of a group offers, all of them in turn. An entry takes what the groups with the greatest tickets
// offer, which do not depend on who comes first.

RL_FN uint groupOfSlot(uint slot, uint every) { return slot / every; }
// The slot of a group whose turn a frame is. The last group may have fewer pixels.
RL_FN uint groupTurn(uint group, uint every, uint frame) {
  uint first = group * every;
  uint size = min(every, gFrame.width * gFrame.height - first);
  return first + (rngHash(group) % size + frame % size) % size;
}
RL_FN uint groupOfferer(uint group, uint every) { return groupTurn(group, every, gFrame.frame); }

// A number of its own for each group or pixel, in an order that changes from frame to frame; 0 for
// one of 2^32, which then waits a frame.
RL_FN uint entryTicket(uint index) {
  return (index + rngSharedBits(0u, RL_DIM_DONOR_U)) * 2654435761u;
}
RL_FN uint entryOfTicket(uint ticket) {
  return ticket * 244002641u - rngSharedBits(0u, RL_DIM_DONOR_U);
}

// Offers itself to an entry, which hears the greatest of each of RL_ENTRY_FEEDERS lots.
RL_FN void groupFeeds(RL_IN(UintRef) feeders, uint entry, uint group) {
  uint ticket = entryTicket(group);
  uint lot = rngHash(ticket) % RL_ENTRY_FEEDERS;
  RL_ATOMIC_MAX(feeders, entry * RL_ENTRY_FEEDERS + lot, ticket);
}
