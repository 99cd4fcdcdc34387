// The shift of a path sample to another pixel: it keeps the film sample, traces x1 anew, and
// reconnects what x1 receives. Two rays, the second only where it decides something.

RL_FN PathShift pathShiftNone() {
  PathShift s;
  s.shifted.F = vec3(0.0f, 0.0f, 0.0f);
  s.shifted.jacobian = 1.0f;
  s.ray.origin = vec3(0.0f, 0.0f, 0.0f);
  s.ray.tMin = 0.0f;
  s.ray.dir = vec3(0.0f, 0.0f, 1.0f);
  s.ray.tMax = 0.0f;
  s.asks = RL_SHIFT_DONE;
  s.assumesVisible = 0u;
  return s;
}

// The key of traceRay(): the film sample's for a path ray; for a segment the body that it lies in,
// which is the camera's, as x1 lets no light through.
RL_FN uint pathShiftKey(uint mode, uint film) {
  return mode == RL_RAY_PATH ? cameraAlphaKey(film) : gFrame.cameraMedia.x;
}

// Can paths be exchanged at an x1 of this frame?
RL_FN bool pathIsReusable(RL_IN(Bsdf) bsdf) {
  return bsdfIsReusable(bsdf, gParams.path.minAlpha) &&
         (gFrame.cameraAbsorbs & RL_CAMERA_ABSORBS_NOW) == 0u;
}

// Of a reservoir's sample to a pixel of this frame's camera or of the last one's. An empty
// reservoir has none.
RL_FN PathShift pathShiftTo(RL_IN(PathReservoir) r, RL_IN(uvec2) pixel, bool isBefore,
                            bool assumeVisible) {
  PathShift s = pathShiftNone();
  if (!(r.state.W > 0.0f)) return s;
  if ((gFrame.cameraAbsorbs & (isBefore ? RL_CAMERA_ABSORBS_BEFORE : RL_CAMERA_ABSORBS_NOW)) != 0u)
    return s;
  if (isBefore) {
    s.ray = cameraFilmRay(gFrame.previousCamera, pixel, r.path.film);
  } else {
    s.ray = cameraFilmRay(gFrame.camera, pixel, r.path.film);
  }
  s.asks = RL_SHIFT_ASKS_X1;
  s.assumesVisible = assumeVisible ? 1u : 0u;
  return s;
}

// To a surface point that is known. One ray.
RL_FN PathShift pathShiftToSurface(RL_IN(PathReservoir) r, RL_IN(Surface) x1) {
  PathShift s = pathShiftNone();
  if (!(r.state.W > 0.0f)) return s;
  s.shifted = pathReconnect(r.path, x1, gParams.path.maxJacobian);
  if (!(reuseTarget(s.shifted.F) > 0.0f)) return s;
  s.ray = pathSegment(r.path, x1.posW, x1.nGeoW, x1.posError);
  s.asks = RL_SHIFT_ASKS_SEGMENT;
  return s;
}

// The next step, with what the ray that was asked for has found.
RL_FN void pathShiftStep(RL_INOUT(PathShift) s, RL_IN(PathSample) path, RL_IN(Hit) hit,
                         float transmittance) {
  uint asked = s.asks;
  s.asks = RL_SHIFT_DONE;
  if (asked == RL_SHIFT_ASKS_SEGMENT) {
    s.shifted.F *= transmittance;
    return;
  }
  if (hit.instance == RL_INVALID) return;
  Surface x1 = surfaceLoad(hit, s.ray.dir);
  if (!bsdfIsReusable(x1.bsdf, gParams.path.minAlpha)) return;
  s.shifted = pathReconnect(path, x1, gParams.path.maxJacobian);
  if (s.assumesVisible != 0u || !(reuseTarget(s.shifted.F) > 0.0f)) return;
  s.ray = pathSegment(path, x1.posW, x1.nGeoW, x1.posError);
  s.asks = RL_SHIFT_ASKS_SEGMENT;
}

// Traces what a shift asks for, by one call.
RL_FN void pathShiftTrace(RL_INOUT(PathShift) s, RL_IN(PathSample) path) {
  while (s.asks != RL_SHIFT_DONE) {
    Hit hit = traceNoHit();
    uint mode = s.asks == RL_SHIFT_ASKS_X1 ? RL_RAY_PATH : RL_RAY_SHADOW;
    uint key = pathShiftKey(mode, path.film);
    float transmittance = traceRay(s.ray, mode, key, hit);
    pathShiftStep(s, path, hit, transmittance);
  }
}
