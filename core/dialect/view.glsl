// The place of a frame among the frames before it.

// Returns whether camera and parameters are those of the frame before.
RL_FN bool viewIsStill() { return gFrame.stillFrames != 0u; }

// Returns whether the view has been still for fewer frames.
RL_FN bool viewIsYoungerThan(uint frames) { return gFrame.stillFrames < frames; }

// Returns whether no frame was rendered since histories were reset.
RL_FN bool isFirstFrame() { return gFrame.frame == 0u; }
