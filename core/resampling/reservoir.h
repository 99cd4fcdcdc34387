// State of every reservoir, without its sample.
#ifndef RL_RESERVOIR_H
#define RL_RESERVOIR_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

struct ReservoirState {
  real3 F;  // integrand of the selected sample at its owner, visibility included; pHat = luminance
  real W;   // unbiased contribution weight: E[F W] is the integral. 0: empty
  real3 residual;  // estimate - F W: part of the per-channel estimate beyond the selected sample
  real confidence;
};

const uint RL_STATE_UVEC4S = 2u;  // per state in a buffer (core/resampling/reservoir.glsl)

// Result of a shift to another pixel or shading point.
struct Shifted {
  real3 F;        // integrand there, visibility included; zero where the shift is undefined
  real jacobian;  // |dT/dx| of the shift; 1 where it is undefined
};

// State of a merge under way.
struct MergeState {
  real cCanonical;
  real cDonors;  // sum over all donors
  real cTotal;   // sum over all inputs that passed the test of the shading points, empty ones too
  real mCanonical;  // MIS weight of the canonical sample
  real wSum;
  real3 estimate;  // per-channel estimate of the integral
};

const uint RL_MAX_DONORS = 4u;  // per merge

// Flags of a merge, declared by the integrator's mode.
const uint RL_REUSE_PAIRWISE = 1u;  // pairwise MIS; otherwise weights by confidence only
// Biased: shifted samples are taken as visible in the MIS weights.
const uint RL_REUSE_ASSUME_VISIBLE = 2u;
const uint RL_REUSE_CONTROL_VARIATE = 4u;  // carry per-channel estimates through the merges
const uint RL_REUSE_WINNER_ONLY = 8u;      // shade the selected sample alone
// Biased: a donor's sample is taken as visible here too.
const uint RL_REUSE_ASSUME_VISIBLE_HERE = 16u;
const uint RL_REUSE_DEFENSIVE = 32u;  // with PAIRWISE: its defensive form

RL_NAMESPACE_END

#endif
