// Validation schedule: each frame checks one of each group of gParams.validateEvery cells, in turn.
RL_FN uint radianceDue(uint group) {
  uint every = gParams.validateEvery;
  return group * every + (rngHash(group) % every + gFrame.frame % every) % every;
}
RL_FN bool radianceIsDue(uint cell) { return radianceDue(cell / gParams.validateEvery) == cell; }
