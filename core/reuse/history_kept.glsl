// Shortens histories of light that has changed (core/temporal_gradients).
#include "core/temporal_gradients/read.glsl"

// The share of a pixel's history that is kept in this frame.
RL_FN float historyKept(uint pixelIndex) {
  return changeHistoryKept(gBuffers.changes, gParams.changes, pixelIndex);
}

// Share of its history that an entry without insertions keeps: its surroundings are out of view.
RL_FN float historyKeptOutOfView(uint entry) {
  Rng rng = rngInit(gFrame.seed, entry, gFrame.frame);
  rng.vertex = RL_VERTEX_CACHE_UPDATE;
  return changeHistoryKeptOutOfView(gBuffers.changes, gParams.changes, rng);
}
