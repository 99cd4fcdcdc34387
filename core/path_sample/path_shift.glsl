// Shift of a path sample to another pixel: keeps the film sample, traces x1 anew, and reconnects x2
// or the light to x1. At most two rays: the second is traced only if it can change the result.

RL_FN PathShift pathShiftNone() {
  PathShift s;
  s.shifted.F = vec3(0.0f, 0.0f, 0.0f);
  s.shifted.jacobian = 1.0f;
  s.ray.origin = vec3(0.0f, 0.0f, 0.0f);
  s.ray.tMin = 0.0f;
  s.ray.dir = vec3(0.0f, 0.0f, 1.0f);
  s.ray.tMax = 0.0f;
  s.needs = RL_SHIFT_DONE;
  s.assumesVisible = 0u;
  s.rank = gFrame.cameraMedia.x;
  s.failed = RL_FAILED_EMPTY;
  return s;
}

// Key of traceRay(). Path ray: the key of the film sample. Segment: the body that the segment lies
// in, which is the camera's, because x1 lets no light through.
RL_FN uint pathShiftKey(uint mode, uint film) {
  return mode == RL_RAY_PATH ? cameraAlphaKey(film) : gFrame.cameraMedia.x;
}

// Returns whether paths can be reused at an x1 of this frame.
RL_FN bool pathIsReusable(RL_IN(Bsdf) bsdf) {
  return bsdfIsReusable(bsdf, gParams.path.minAlpha) &&
         (gFrame.cameraAbsorbs & RL_CAMERA_ABSORBS_NOW) == 0u;
}

// Begins the shift of a reservoir's sample to a pixel, seen by this frame's camera or by the last
// frame's (isPrevious). An empty reservoir has no shift.
RL_FN PathShift pathShiftTo(RL_IN(PathReservoir) r, RL_IN(uvec2) pixel, bool isPrevious,
                            bool assumeVisible) {
  PathShift s = pathShiftNone();
  if (!(r.state.W > 0.0f)) return s;
  s.failed = RL_FAILED_ABSORBED;
  if ((gFrame.cameraAbsorbs & (isPrevious ? RL_CAMERA_ABSORBS_BEFORE : RL_CAMERA_ABSORBS_NOW)) !=
      0u)
    return s;
  if (isPrevious) {
    s.ray = cameraFilmRay(gFrame.previousCamera, pixel, r.path.film);
  } else {
    s.ray = cameraFilmRay(gFrame.camera, pixel, r.path.film);
  }
  s.needs = RL_SHIFT_NEEDS_X1;
  s.assumesVisible = assumeVisible || pathHasUnshadowedTarget() ? 1u : 0u;
  return s;
}

// Begins the shift of a reservoir's sample to a known surface point. One ray.
RL_FN PathShift pathShiftToSurface(RL_IN(PathReservoir) r, RL_IN(Surface) x1) {
  PathShift s = pathShiftNone();
  if (!(r.state.W > 0.0f)) return s;
#ifdef RL_PATH_REPLAYS
  // Which vertices connect to a surface point depends on the camera, which an entry has not:
  // entries hold direct light alone, or what needs no footprint.
  s.failed = RL_FAILED_ENTRY;
  if (r.path.base != 0u || pathKind(r.path) >= RL_PATH_WEIGHED) return s;
  if (gParams.path.footprint > 0.0f && !pathEndsAtLight(r.path)) return s;
#endif
  LightSample end = pathEnd(r.path);
  s.shifted = pathReconnect(r.path, end, x1, gParams.path.maxJacobian, s.failed);
  if (!(reuseTarget(s.shifted.F) > 0.0f)) return s;
  s.failed = RL_FAILED_NOT;
  if (pathHasUnshadowedTarget()) return s;
  s.ray = pathSegment(end, x1.posW, x1.nGeoW, x1.posError);
  s.needs = RL_SHIFT_NEEDS_SEGMENT;
  return s;
}

#ifdef RL_PATH_REPLAYS
// Replays a path from its camera ray, and reconnects it or keeps what it found.
RL_FN void pathShiftReplay(RL_INOUT(PathShift) s, RL_IN(PathSample) path) {
  s.needs = RL_SHIFT_DONE;
  PathReplay q = pathReplay(path, s.ray);
  s.failed = q.failed;
  if (q.failed != RL_FAILED_NOT) return;
  if (q.kind == RL_PATH_WHOLE_REPLAY) {
    s.shifted.F = q.radiance;
    if (!(reuseTarget(q.radiance) > 0.0f)) s.failed = RL_FAILED_DARK;
    return;
  }
  LightSample end = pathEnd(path);
  s.shifted = pathReconnect(path, end, q.x, gParams.path.maxJacobian, s.failed);
  if (!pathReconnects(q, path, end)) {
    s.shifted.F = vec3(0.0f, 0.0f, 0.0f);
    s.failed = RL_FAILED_PAIR;
  }
  s.shifted.F *= q.throughput;
  LightConnection c = lightConnect(end, q.x.posW);
  if (RL_HAS(RL_FEATURE_VOLUME)) s.shifted.F *= exp(-q.sigma * c.distance);
  if (!(reuseTarget(s.shifted.F) > 0.0f)) return;
  s.failed = RL_FAILED_NOT;
  if (s.assumesVisible != 0u) return;
  s.ray = pathSegment(end, q.x.posW, q.x.nGeoW, q.x.posError);
  s.rank = q.rank;
  s.needs = RL_SHIFT_NEEDS_SEGMENT;
}
#endif

// Advances a shift with the result of the ray that it asked for.
RL_FN void pathShiftStep(RL_INOUT(PathShift) s, RL_IN(PathSample) path, RL_IN(Hit) hit,
                         float transmittance) {
  uint asked = s.needs;
  s.needs = RL_SHIFT_DONE;
  if (asked == RL_SHIFT_NEEDS_SEGMENT) {
    s.shifted.F *= transmittance;
    if (!(transmittance > 0.0f)) s.failed = RL_FAILED_OCCLUDED;
    return;
  }
  s.failed = RL_FAILED_BACKGROUND;
  if (hit.instance == RL_INVALID) return;
  Surface x1 = surfaceLoad(hit, s.ray.dir);
  s.failed = RL_FAILED_SMOOTH;
  if (!bsdfIsReusable(x1.bsdf, gParams.path.minAlpha)) return;
  LightSample end = pathEnd(path);
  s.shifted = pathReconnect(path, end, x1, gParams.path.maxJacobian, s.failed);
  if (!(reuseTarget(s.shifted.F) > 0.0f)) return;
  s.failed = RL_FAILED_NOT;
  if (s.assumesVisible != 0u) return;
  s.ray = pathSegment(end, x1.posW, x1.nGeoW, x1.posError);
  s.needs = RL_SHIFT_NEEDS_SEGMENT;
}

// Traces the rays that a shift asks for, from one call site.
RL_FN void pathShiftTrace(RL_INOUT(PathShift) s, RL_IN(PathSample) path) {
#ifdef RL_PATH_REPLAYS
  if (s.needs == RL_SHIFT_NEEDS_X1) pathShiftReplay(s, path);
#endif
  while (s.needs != RL_SHIFT_DONE) {
    Hit hit = traceNoHit();
    uint mode = s.needs == RL_SHIFT_NEEDS_X1 ? RL_RAY_PATH : RL_RAY_SHADOW;
    uint key = mode == RL_RAY_PATH ? cameraAlphaKey(path.film) : s.rank;
    float transmittance = traceRay(s.ray, mode, key, hit);
    pathShiftStep(s, path, hit, transmittance);
  }
}
