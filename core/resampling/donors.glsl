// Confidence with which donors enter a merge, and the scale of their residuals.
// Nothing here may depend on samples.

// A donor's confidence after the cap, counted when the cap acts.
RL_FN real reuseCapped(real confidence, real cap) {
  real capped = min(confidence, cap);
  if (capped < confidence) RL_HEALTH(RL_HEALTH_CAPPED_CONFIDENCE);
  return capped;
}

// Share of its confidence with which a spatial donor enters the merge of a pixel whose history
// holds `age` frames of this view. A history averages a pixel's own noise down, but not the
// difference of two pixels at a donor's one sample. That difference is the part `noise` of a
// frame's variance, and a donor's estimate, at best as good as the pixel's own, is worth
// 1 / (1 + noise (age - 1)) of it. Any share that does not depend on the samples is unbiased.
RL_FN real reuseDonorShare(real age, real noise) {
  return real(1.0f) / (real(1.0f) + noise * (age - real(1.0f)));
}

// Scale of residuals, which scale with the surface: expected integrand of `to` over that of
// `from`. At most `bound` per channel.
RL_FN real3 reuseReflectanceRatio(RL_IN(real3) from, RL_IN(real3) to, real bound) {
  real3 ratio = real3(misDivide(to.x, from.x), misDivide(to.y, from.y), misDivide(to.z, from.z));
  return min(ratio, real3(bound));
}
