// Selects which pixels offer their sample in a frame. Adjacent pixels form groups; each frame one
// pixel of a group offers, in turn. An entry takes the offers of the groups with the greatest
// tickets (priorities), which do not depend on execution order.

RL_FN uint groupOfSlot(uint slot, uint every) { return slot / every; }
// Slot of the pixel of a group whose turn it is in a frame. The last group may have fewer pixels.
RL_FN uint groupTurn(uint group, uint every, uint frame) {
  uint first = group * every;
  uint size = min(every, gFrame.width * gFrame.height - first);
  return first + (rngHash(group) % size + frame % size) % size;
}
RL_FN uint groupOfferer(uint group, uint every) { return groupTurn(group, every, gFrame.frame); }

// Ticket (priority) of a group or pixel: unique, in an order that changes from frame to frame. 0
// for one of 2^32 indices, which then waits a frame.
RL_FN uint entryTicket(uint index) {
  return (index + rngSharedBits(0u, RL_DIM_DONOR_U)) * 2654435761u;
}
RL_FN uint entryOfTicket(uint ticket) {
  return ticket * 244002641u - rngSharedBits(0u, RL_DIM_DONOR_U);
}

// Offers a group to an entry. The entry takes the greatest ticket of each of RL_ENTRY_FEEDERS lots.
RL_FN void groupFeeds(RL_IN(UintRef) feeders, uint entry, uint group) {
  uint ticket = entryTicket(group);
  uint lot = rngHash(ticket) % RL_ENTRY_FEEDERS;
  RL_ATOMIC_MAX(feeders, entry * RL_ENTRY_FEEDERS + lot, ticket);
}
