// Resampling MIS weights. c are confidences, C their sum over all inputs, pHatFrom the target of an
// input pulled back to the canonical domain: pHat_i(T_i^-1(y)) |dT_i^-1/dy|, which for a sample y
// that came from i is pHat_i(x_i) / J (GRIS eq. 35).

// x / y, 0 where y is 0.
RL_FN real misDivide(real x, real y) { return y > real(0.0f) ? x / y : real(0.0f); }

// Defensive pairwise weight of donor i (Wyman et al. 2023, course notes algorithm 7).
RL_FN real misPairwiseDonor(real cI, real cCanonical, real cTotal, real pHatFromI,
                            real pHatCanonical) {
  real others = cTotal - cCanonical;
  return cI / cTotal *
         misDivide(others * pHatFromI, others * pHatFromI + cCanonical * pHatCanonical);
}

// The canonical sample's weight is cCanonical / cTotal plus this term for every donor j.
RL_FN real misPairwiseCanonicalTerm(real cJ, real cCanonical, real cTotal, real pHatCanonical,
                                    real pHatFromJ) {
  real others = cTotal - cCanonical;
  return cJ / cTotal *
         misDivide(cCanonical * pHatCanonical, cCanonical * pHatCanonical + others * pHatFromJ);
}

// Weights that ignore who could have produced the sample: 1/M of Bitterli et al. 2020. Biased where
// supports differ; kept as a declared mode and for the tests that must reject it.
RL_FN real misConfidenceOnly(real cI, real cTotal) { return cI / cTotal; }
