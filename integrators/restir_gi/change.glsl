// restir_gi: histories of light that is no more (core/changes).
#include "core/changes/read.glsl"

// The share of a pixel's history that is kept in this frame.
RL_FN float giKept(uint slot) { return changeKept(gBuffers.changes, gParams.changes, slot); }

// The share that an entry keeps which nobody feeds: what it lies beside is not in view.
RL_FN float giKeptOutOfView(uint entry) {
  Rng rng = rngInit(gFrame.seed, entry, gFrame.frame);
  rng.vertex = RL_VERTEX_FEED;
  return changeKeptOutOfView(gBuffers.changes, gParams.changes, rng);
}
