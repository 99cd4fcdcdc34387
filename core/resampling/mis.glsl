// Resampling MIS weights. c are confidences, pHatFrom is the target of an input pulled back to the
// canonical domain: pHat_i(T_i^-1(y)) |dT_i^-1/dy|, which for a sample y that came from i is
// pHat_i(x_i) / J (GRIS eq. 35).

// x / y, 0 where y is 0.
RL_FN real misDivide(real x, real y) { return y > real(0.0f) ? x / y : real(0.0f); }

// Pairwise MIS (Lin et al. 2022, section 5.4): each donor is weighed against the canonical input
// alone, as if all donors were like it. If targets are equal, a weight is the input's share of the
// confidence. The defensive form (Wyman et al. 2023, algorithm 7) first gives the canonical sample
// its share of every donor's part. cDonors: sum over all donors.
RL_FN real misPairwiseDonor(real cI, real cCanonical, real cDonors, real pHatFromI,
                            real pHatCanonical, bool isDefensive) {
  real share = misDivide(cI, isDefensive ? cCanonical + cDonors : cDonors);
  return share * misDivide(cDonors * pHatFromI, cDonors * pHatFromI + cCanonical * pHatCanonical);
}

// Term of donor j in the canonical sample's weight. The weight is the sum of these terms over all
// donors, in the defensive form plus the canonical sample's share of the confidence; 1 without
// donors.
RL_FN real misPairwiseCanonicalTerm(real cJ, real cCanonical, real cDonors, real pHatCanonical,
                                    real pHatFromJ, bool isDefensive) {
  real share = misDivide(cJ, isDefensive ? cCanonical + cDonors : cDonors);
  return share *
         misDivide(cCanonical * pHatCanonical, cCanonical * pHatCanonical + cDonors * pHatFromJ);
}

// MIS weights by confidence alone, which ignore who could have produced the sample: 1/M of Bitterli
// et al. 2020. Biased if supports differ; kept as a declared mode and for the tests that must
// reject it.
RL_FN real misConfidenceOnly(real cI, real cTotal) { return cI / cTotal; }
