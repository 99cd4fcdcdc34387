// restir_gi: shortens histories of light that has changed (core/changes).
#include "core/changes/read.glsl"

// The share of a pixel's history that is kept in this frame.
RL_FN float giKept(uint slot) { return changeKept(gBuffers.changes, gParams.changes, slot); }

// Share of its history that an entry without feeders keeps: its surroundings are out of view.
RL_FN float giKeptOutOfView(uint entry) {
  Rng rng = rngInit(gFrame.seed, entry, gFrame.frame);
  rng.vertex = RL_VERTEX_FEED;
  return changeKeptOutOfView(gBuffers.changes, gParams.changes, rng);
}
