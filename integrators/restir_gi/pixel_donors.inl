// Candidates of a merge, one by one. Included inside a kernel context, after
// core/resampling/merge.glsl and core/path_sample/path_shift.glsl.

// Sum of the confidences of all donors, after caps.
real confidenceOf(const RL_REUSE_STATE& s, uint count) {
  ReservoirState donor = reservoirEmpty();
  real sum = 0.0f;
  for (uint k = 0; k < count; ++k) {
    if (reuseDonor(s, k, donor)) sum += donor.confidence;
  }
  return sum;
}

// Names the first test that the shift of a sample to the pixel fails, in the order of
// pathShiftStep(), with x1 seen through `film`.
const char* failedTest(const PathReservoir& r, const uvec2& pixel, uint film) {
  if (!(r.state.W > 0.0f)) return "empty";
  const Ray ray = cameraFilmRay(gFrame.camera, pixel, film);
  Hit hit = traceNoHit();
  traceRay(ray, RL_RAY_PATH, cameraAlphaKey(film), hit);
  if (hit.instance == RL_INVALID) return "background";
  const Surface x1 = surfaceLoad(hit, ray.dir);
  if (!bsdfIsReusable(x1.bsdf, gParams.path.minAlpha)) return "smooth";
  const auto rejected = gCounters.health[RL_HEALTH_REJECTED_JACOBIAN];
  const Shifted shifted = pathReconnect(r.path, pathEnd(r.path), x1, gParams.path.maxJacobian);
  if (gCounters.health[RL_HEALTH_REJECTED_JACOBIAN] != rejected) return "jacobian";
  return reuseTarget(shifted.F) > 0.0f ? "occluded" : "dark";
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
