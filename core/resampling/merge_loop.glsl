// The reuse loop: merges a reservoir, the canonical one, with those of its donors, over time or
// over space, for any sample and cache (core/resampling/merge.glsl has the algebra).
//
// The includer defines RL_REUSE_STATE, a struct, and before the #include the functions below, which
// get it. Each must return the same result on every call:
// - bool reuseDonor(state, k, out ReservoirState): the k-th donor, with the confidence that it
//   enters with; false: there is none
// - Shifted reuseCanonicalAtNeighbour(state, k): the canonical sample shifted to that donor
// - Shifted reuseNeighbourAtCanonical(state, k): that donor's sample shifted to the canonical
//   domain
// - real3 reuseRatio(state, k): expected integrand here over that at the donor, known without
//   samples: scales the donors' residuals
// - real reuseUniform(state, k): a number in [0, 1)

// RL_REUSE_WATCH_CANONICAL(merge, canonical) and RL_REUSE_WATCH_DONOR(k, donor, shifted, merge,
// isSelected) show each candidate to who asks what a merge did (Session::donors()). Kernels leave
// them empty.
#ifndef RL_REUSE_WATCH_DONOR
#define RL_REUSE_WATCH_CANONICAL(merge, canonical)
#define RL_REUSE_WATCH_DONOR(k, donor, shifted, merge, isSelected)
#endif

// Merges `count` donors. `r` becomes the state of the selected sample. `winner` is the donor that
// the sample came from, RL_INVALID if the canonical sample stays; `jacobian` is that of the
// winner's shift. Returns the per-channel estimate of the integral.
RL_FN real3 reuseMerge(RL_IN(RL_REUSE_STATE) state, uint count, uint flags,
                       RL_INOUT(ReservoirState) r, RL_OUT(uint) winner, RL_OUT(real) jacobian) {
  winner = RL_INVALID;
  jacobian = real(1.0f);
  ReservoirState donor = r;
  real cDonors = real(0.0f);
  for (uint k = 0u; k < count; k = k + 1u) {
    if (reuseDonor(state, k, donor)) cDonors += donor.confidence;
  }
  MergeState merge = mergeBegin(r, cDonors, flags);
  for (uint k = 0u; k < count; k = k + 1u) {
    if (!reuseDonor(state, k, donor)) continue;
    mergeWeighCanonical(merge, r, donor.confidence, reuseCanonicalAtNeighbour(state, k), flags);
  }
  mergeCanonical(merge, r, flags);
  RL_REUSE_WATCH_CANONICAL(merge, r)
  for (uint k = 0u; k < count; k = k + 1u) {
    if (!reuseDonor(state, k, donor)) continue;
    Shifted neighbourAtCanonical = reuseNeighbourAtCanonical(state, k);
    bool isSelected = mergeDonor(merge, r, donor, neighbourAtCanonical, reuseRatio(state, k), flags,
                                 reuseUniform(state, k));
    RL_REUSE_WATCH_DONOR(k, donor, neighbourAtCanonical, merge, isSelected)
    if (isSelected) {
      winner = k;
      jacobian = neighbourAtCanonical.jacobian;
    }
  }
  mergeEnd(merge, r, flags);
  return merge.estimate;
}
