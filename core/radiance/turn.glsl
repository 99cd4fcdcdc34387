// One of gParams.validateEvery cells is looked at in a frame, all of them in turn.
RL_FN bool radianceIsDue(uint cell) {
  return (rngHash(cell) % gParams.validateEvery + gFrame.frame) % gParams.validateEvery == 0u;
}
