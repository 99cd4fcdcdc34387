// Light that changed between two frames (core/changes/README.md): what histories read of it.
#ifndef RL_CHANGES_H
#define RL_CHANGES_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

// In the kernels' gParams. Pixels side by side are a group; each frame one of them is asked.
struct ChangeParams {
  uint every;      // pixels of a group; 0: nobody asks
  float response;  // share of a history that is forgotten, over the share of light that has changed
};

// Of a group: luminance of the path of the one whose turn it was, and the tag of that frame; by how
// much it differed when it was traced again, and the greater of both; the share of the light around
// that has changed.
struct ChangeBuffers {
  UintRef found;
  UintRef differences;
  UintRef changes;
};

const uint RL_CHANGE_SEED = 0x5bd1e995u;  // its paths are not those of the pixels
// Largest difference of two results of one path over their sum.
const float RL_CHANGE_SAME = 1.0e-3f;
const uint RL_CHANGE_ROWS = 12u;    // of pixels, above and below, over which changes are averaged
const uint RL_CHANGE_PLACES = 16u;  // of the image, at which looks who is out of view

RL_NAMESPACE_END

#endif
