// Candidates of a merge, one by one. Included inside a kernel context, after
// core/resampling/merge.glsl.

// Sum of the confidences of all donors, after caps.
real confidenceOf(const RL_REUSE_STATE& s, uint count) {
  ReservoirState donor = reservoirEmpty();
  real sum = 0.0f;
  for (uint k = 0; k < count; ++k) {
    if (reuseDonor(s, k, donor)) sum += donor.confidence;
  }
  return sum;
}

// Describes a donor of a merge. `share` is the resampling weight until the caller divides it by the
// sum of weights.
restlab::Donor asDonor(const char* reuse, size_t id, const ReservoirState& donor,
                       const Shifted& here, MergeState merge, uint flags) {
  restlab::Donor out;
  out.reuse = reuse;
  out.id = id;
  out.confidence = donor.confidence;
  out.shift = "accepted";
  if (!(reuseTarget(here.F) > 0.0f)) return out;
  ReservoirState alone = reservoirEmpty();
  merge.wSum = 0.0f;
  mergeDonor(merge, alone, donor, here, real3(0.0f), flags, 0.0f);
  out.jacobian = here.jacobian;
  out.share = merge.wSum;
  out.misWeight = merge.wSum / (reuseTarget(here.F) * donor.W * here.jacobian);
  return out;
}
