// Resampled importance sampling, streaming (Talbot 2005; Bitterli et al. 2020; Lin et al. 2022,
// GRIS). Written with `real`, so that the exact tests run these very lines in double precision.

// Sanitises a resampling weight: negative, non-finite and subnormal ones become zero, and all but
// the subnormal ones are counted. (A sum of weights below 2^-125 cannot be divided by without
// overflow.)
RL_FN real risCleanWeight(real w) {
  if (!(w >= real(0.0f) && w <= real(3.0e38f))) RL_HEALTH(RL_HEALTH_DROPPED_WEIGHTS);
  return w >= real(2.350988701644575e-38f) && w <= real(3.0e38f) ? w : real(0.0f);
}

// Adds a candidate of weight w; true when it becomes the selected one. u is uniform in [0, 1) and
// must be strictly below 1: a zero weight then never wins.
RL_FN bool risAccept(RL_INOUT(real) wSum, real w, real u) {
  real clean = risCleanWeight(w);
  wSum += clean;
  return u * wSum < clean;
}

// Unbiased contribution weight of the selected sample: W = wSum / pHat (GRIS eq. 22).
RL_FN real risContributionWeight(real wSum, real pHat) {
  return pHat > real(0.0f) ? wSum / pHat : real(0.0f);
}
