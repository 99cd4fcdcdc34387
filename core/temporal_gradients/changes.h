// Light that changed between two frames (core/temporal_gradients/README.md): parameters and
// buffers.
#ifndef RL_CHANGES_H
#define RL_CHANGES_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

// In the kernels' gParams. Adjacent pixels form groups; each frame validates one pixel of a group.
struct ChangeParams {
  uint every;      // pixels per group; 0: off
  float response;  // share of a history that is forgotten, over the share of light that has changed
};

// Per group. found: luminance of the path that was traced, and the tag of its frame. differences:
// by how much the luminance differed when the path was traced again, and the greater of both.
// changes: share of the light around the group that has changed.
struct ChangeBuffers {
  UintRef found;
  UintRef differences;
  UintRef changes;
};

const uint RL_CHANGE_SEED = 0x5bd1e995u;  // validation paths differ from the paths of the pixels
// Largest difference of two results of one path over their sum at which they count as equal.
const float RL_CHANGE_SAME = 1.0e-3f;
const uint RL_CHANGE_ROWS = 12u;    // rows of pixels above and below that are averaged
const uint RL_CHANGE_PLACES = 16u;  // places of the image averaged for surfaces out of view

RL_NAMESPACE_END

#endif
