// Parameters of pairs: pixels that serve each other as spatial donors.
#ifndef RL_PAIRS_H
#define RL_PAIRS_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

// In the kernels' gParams.pairs.
struct PairParams {
  uint tile;  // pixels; side of the square within which pixels are paired
  SimilarityThresholds similarity;
};

RL_NAMESPACE_END

#endif
