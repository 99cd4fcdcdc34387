// The reuse algebra: merges donors' reservoirs into the canonical one by generalised RIS with shift
// maps and pairwise MIS (Lin et al. 2022). Independent of BSDF, sample, pixel and backend: the
// same lines serve every method and cache, time and space.
//
// Order of calls: mergeBegin(), for every donor mergeWeighCanonical() with the canonical sample
// shifted to the donor, mergeCanonical(), for every donor mergeDonor() with the donor's sample
// shifted here, mergeEnd() (core/resampling/merge_loop.glsl).
//
// Per-channel estimates: the selected sample carries one colour, which a scalar target cannot see.
// Each reservoir therefore also carries an estimate E of the whole integral per channel, E = F W +
// residual with E[residual] = 0 given the shading points. A donor's residual, weighted by its share
// of the confidence and by the expected ratio of reflectances, is a control variate: the weight
// depends on no sample, so the expectation stays zero, and the residual cancels the colour noise of
// the donor's selection.

// canonical: this shading point's own reservoir; cDonors: the donors' confidences after the cap,
// summed.
RL_FN MergeState mergeBegin(RL_IN(ReservoirState) canonical, real cDonors, uint flags) {
  MergeState merge;
  merge.cCanonical = canonical.confidence;
  merge.cTotal = canonical.confidence + cDonors;
  merge.cDonors = cDonors;
  merge.mCanonical = merge.cCanonical / merge.cTotal;
  bool isPairwise = (flags & RL_REUSE_PAIRWISE) != 0u && (flags & RL_REUSE_DEFENSIVE) == 0u;
  if (isPairwise && cDonors > real(0.0f)) merge.mCanonical = real(0.0f);
  merge.wSum = real(0.0f);
  merge.estimate = real3(real(0.0f));
  return merge;
}

// Identity shift, to a shading point at the same point: no evaluation, no ray, the integrand
// stays.
RL_FN Shifted mergeUnshifted(RL_IN(ReservoirState) r) {
  Shifted s;
  s.F = r.F;
  s.jacobian = real(1.0f);
  return s;
}

// Adds a donor's term to the canonical MIS weight. there: the canonical sample shifted to the
// donor, cDonor: the donor's confidence.
RL_FN void mergeWeighCanonical(RL_INOUT(MergeState) merge, RL_IN(ReservoirState) canonical,
                               real cDonor, RL_IN(Shifted) there, uint flags) {
  if ((flags & RL_REUSE_PAIRWISE) == 0u) return;
  real pHatThere = reuseTarget(there.F) * there.jacobian;
  merge.mCanonical +=
      misPairwiseCanonicalTerm(cDonor, merge.cCanonical, merge.cDonors, reuseTarget(canonical.F),
                               pHatThere, (flags & RL_REUSE_DEFENSIVE) != 0u);
}

// The canonical sample is the first candidate: it stays selected until a donor wins.
RL_FN void mergeCanonical(RL_INOUT(MergeState) merge, RL_IN(ReservoirState) canonical, uint flags) {
  real contribution = merge.mCanonical * canonical.W;
  merge.estimate = canonical.F * contribution;
  if ((flags & RL_REUSE_CONTROL_VARIATE) != 0u) {
    merge.estimate += canonical.residual * (merge.cCanonical / merge.cTotal);
  }
  merge.wSum = risCleanWeight(reuseTarget(canonical.F) * contribution);
}

// Adds a donor's sample, shifted here, as a candidate. Returns true if it is selected: the caller
// then takes the donor's sample; `selected.F` is already set. reflectanceRatio: expected integrand
// here over that at the donor, from the shading points alone.
RL_FN bool mergeDonor(RL_INOUT(MergeState) merge, RL_INOUT(ReservoirState) selected,
                      RL_IN(ReservoirState) donor, RL_IN(Shifted) here,
                      RL_IN(real3) reflectanceRatio, uint flags, real u) {
  real pHatHere = reuseTarget(here.F);
  real cDonor = donor.confidence;
  real mDonor = misConfidenceOnly(cDonor, merge.cTotal);
  if ((flags & RL_REUSE_PAIRWISE) != 0u) {
    real pHatFrom = misDivide(reuseTarget(donor.F), here.jacobian);
    mDonor = misPairwiseDonor(cDonor, merge.cCanonical, merge.cDonors, pHatFrom, pHatHere,
                              (flags & RL_REUSE_DEFENSIVE) != 0u);
  }
  real contribution = mDonor * donor.W * here.jacobian;
  merge.estimate += here.F * contribution;
  if ((flags & RL_REUSE_CONTROL_VARIATE) != 0u) {
    merge.estimate += donor.residual * reflectanceRatio * (cDonor / merge.cTotal);
  }
  if (!risAccept(merge.wSum, pHatHere * contribution, u)) return false;
  selected.F = here.F;
  return true;
}

// Completes the state of the selected sample; merge.estimate is then what the pixel shows.
RL_FN void mergeEnd(RL_INOUT(MergeState) merge, RL_INOUT(ReservoirState) selected, uint flags) {
  selected.W = risContributionWeight(merge.wSum, reuseTarget(selected.F));
  if (!(selected.W > real(0.0f))) {
    selected.W = real(0.0f);
    selected.F = real3(real(0.0f));
  }
  // Count all inputs that passed the test of the shading points, empty ones too: c must not depend
  // on samples.
  selected.confidence = merge.cTotal;
  real3 shaded = selected.F * selected.W;
  if ((flags & RL_REUSE_WINNER_ONLY) != 0u) merge.estimate = shaded;
  selected.residual = real3(real(0.0f));
  if ((flags & RL_REUSE_CONTROL_VARIATE) != 0u) selected.residual = merge.estimate - shaded;
}
