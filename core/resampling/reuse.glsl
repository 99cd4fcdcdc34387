// The reuse loop: merges donors' reservoirs into the canonical one by generalised RIS with shift maps
// (Lin et al. 2022) and defensive pairwise MIS. It knows no BSDF, no pixel and no backend; the same
// lines serve every payload, every cache, time and space.
//
// Included once per payload type with RL_RESERVOIR (a struct with a ReservoirState `state`) and
// RL_ANCHOR (where a sample is evaluated) defined. The bridge, per payload type:
//   bridgeReadDonor(slot, reservoir)          the donor's reservoir
//   bridgeReadAnchor(slot, anchor)            and where it lives
//   bridgeShift(reservoir, from, to, J)       integrand of the shifted sample at `to` without visibility;
//                                             zero where the shift is undefined (by a predicate that is
//                                             the same in both directions)
//   bridgeVisibility(reservoir, at)           transmittance between a sample and an anchor
//   bridgeIsSameAnchor(from, to)              the same point seen from the same side: the shift is the identity
//   bridgeReflectanceRatio(from, to)          expected ratio of the integrands, from the anchors alone
// and for all of them bridgeTarget(F), the scalar target.
//
// Per-channel estimates: the selected sample carries one colour, which a scalar target cannot see.
// Each reservoir therefore also carries an estimate E of the whole integral per channel, E = F W +
// residual with E[residual] = 0 given the anchors. A donor's residual, weighted by its share of the
// confidence and by the expected ratio of reflectances, is a control variate: it depends on no sample,
// so its expectation stays zero, and it cancels the colour noise of the donor's selection.

RL_FN void reuseMerge(RL_INOUT(RL_RESERVOIR) canonical, RL_IN(RL_ANCHOR) here, RL_IN(DonorSet) donors,
                      uint flags, RL_IN(Rng) rng, uint dimension, RL_OUT(real3) estimate) {
  bool pairwise = (flags & RL_REUSE_PAIRWISE) != 0u;
  real cCanonical = canonical.state.confidence;
  real cTotal = cCanonical;
  for (uint k = 0u; k < donors.count; k = k + 1u) cTotal += donors.confidence[k];

  RL_RESERVOIR selected = canonical;
  RL_RESERVOIR donor = canonical;
  RL_ANCHOR there = here;
  real wSum = real(0.0f);
  real mCanonical = cCanonical / cTotal;
  real pHatCanonical = bridgeTarget(canonical.state.F);
  real3 shiftedF = real3(real(0.0f));
  real shiftedJ = real(1.0f);
  bool isSame = false;
  estimate = real3(real(0.0f));

  // Two shifts a donor through one call site: its sample to here, then the canonical one to it.
  for (uint turn = 0u; turn < 2u * donors.count; turn = turn + 1u) {
    uint k = turn >> 1u;
    bool forward = (turn & 1u) == 0u;
    if (forward) {
      bridgeReadDonor(donors.slot[k], donor);
      bridgeReadAnchor(donors.slot[k], there);
      isSame = bridgeIsSameAnchor(there, here);
    }
    bool needed = forward ? donor.state.W > real(0.0f) : (pairwise && canonical.state.W > real(0.0f));
    real3 f = real3(real(0.0f));
    real jacobian = real(1.0f);
    if (needed && isSame) {
      // Nothing to evaluate, no ray: every sample keeps its integrand.
      f = forward ? donor.state.F : canonical.state.F;
    } else if (needed) {
      if (forward) {
        f = bridgeShift(donor, there, here, jacobian);
      } else {
        f = bridgeShift(canonical, here, there, jacobian);
      }
      bool assumed = forward ? (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u : (flags & RL_REUSE_ASSUME_VISIBLE) != 0u;
      if (!assumed && bridgeTarget(f) > real(0.0f)) {
        if (forward) {
          f *= bridgeVisibility(donor, here);
        } else {
          f *= bridgeVisibility(canonical, there);
        }
      }
    }
    if (forward) {
      shiftedF = f;
      shiftedJ = jacobian;
      continue;
    }
    real cDonor = donors.confidence[k];
    real pHatHere = bridgeTarget(shiftedF);
    real weightJ = (flags & RL_REUSE_OMIT_JACOBIAN) != 0u ? real(1.0f) : shiftedJ;
    real mDonor = misConfidenceOnly(cDonor, cTotal);
    if (pairwise) {
      real pHatFrom = misDivide(bridgeTarget(donor.state.F), shiftedJ);
      mDonor = misPairwiseDonor(cDonor, cCanonical, cTotal, pHatFrom, pHatHere);
      real pHatThere = bridgeTarget(f) * jacobian;
      mCanonical += misPairwiseCanonicalTerm(cDonor, cCanonical, cTotal, pHatCanonical, pHatThere);
    }
    real contribution = mDonor * donor.state.W * weightJ;
    estimate += shiftedF * contribution;
    if ((flags & RL_REUSE_CONTROL_VARIATE) != 0u) {
      estimate += donor.state.residual * bridgeReflectanceRatio(there, here) * (cDonor / cTotal);
    }
    real u = real(rngDraw(rng, dimension + k));
    if (risAccept(wSum, pHatHere * contribution, u)) {
      selected = donor;
      selected.state.F = shiftedF;
    }
  }

  estimate += canonical.state.F * (mCanonical * canonical.state.W);
  if ((flags & RL_REUSE_CONTROL_VARIATE) != 0u) estimate += canonical.state.residual * (cCanonical / cTotal);
  real uCanonical = real(rngDraw(rng, dimension + RL_MAX_DONORS));
  if (risAccept(wSum, pHatCanonical * mCanonical * canonical.state.W, uCanonical)) {
    selected = canonical;
  }
  selected.state.W = risContributionWeight(wSum, bridgeTarget(selected.state.F));
  if (!(selected.state.W > real(0.0f))) {
    selected.state.W = real(0.0f);
    selected.state.F = real3(real(0.0f));
  }
  // All inputs that passed the test of the anchors count, empty ones too: c must not depend on samples.
  selected.state.confidence = cTotal;
  real3 shaded = selected.state.F * selected.state.W;
  if ((flags & RL_REUSE_WINNER_ONLY) != 0u) estimate = shaded;
  selected.state.residual = real3(real(0.0f));
  if ((flags & RL_REUSE_CONTROL_VARIATE) != 0u) selected.state.residual = estimate - shaded;
  canonical = selected;
}
