// Where a path is reconnected: at the first pair of vertices that are both rough, and far enough
// apart that one sample of the density stands for an area worth exchanging (the footprint criterion
// of Lin, Kettunen and Wyman 2026). The same index on both sides, or the shift is undefined.

RL_FN PathConnector pathConnectorNone() {
  PathConnector c;
  c.posW = vec3(0.0f, 0.0f, 0.0f);
  c.isRough = 0u;
  c.footprint = 0.0f;
  return c;
}

// Area of x1 that a uniform sphere of rays from the camera gives a ray. origin: of the camera ray.
RL_FN float pathFootprintOfX1(RL_IN(Surface) x1, RL_IN(vec3) origin) {
  vec3 d = x1.posW - origin;
  return 12.566371f * dot(d, d) * rlSafeDivide(1.0f, abs(dot(x1.nGeoW, x1.wo)));
}

// Returns whether a vertex is rough: paths can be reconnected from it and to it.
RL_FN bool pathIsRough(RL_IN(Surface) s) {
  if (RL_HAS(RL_FEATURE_VOLUME) && s.contrast > 0.0f) return false;
  return bsdfIsReusable(s.bsdf, gParams.path.minAlpha);
}

// Returns whether a vertex is a mirror whose direct light is part of the light in view, if the
// camera sees it directly or in other mirrors. It is smooth in every method, and no path ends in a
// cell there.
RL_FN bool pathIsMirror(RL_IN(Surface) s) {
  float maxAlpha = min(gParams.path.minAlpha, RL_MIRROR_ALPHA);
  if (gParams.cells.count != 0u) maxAlpha = min(maxAlpha, gParams.cells.minAlpha);
  return bsdfIsMirror(s.bsdf, maxAlpha);
}

// Returns whether the light samples of a vertex are not resampled: those behind a surface that lets
// light through lie in a body that a replay does not know. The scene decides, not the kernel: one
// with more features than the scene needs takes the same samples.
RL_FN bool pathIsLightUnresampled(RL_IN(Surface) s) {
#ifdef RL_PATH_REPLAYS
  return RL_HAS(RL_FEATURE_VOLUME) && gScene.hasMedia != 0u &&
         (s.bsdf.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u;
#else
  return false;
#endif
}

// Returns whether a vertex of a segment is wide enough. geometry: |cos| / d^2 at x_k; d2: squared
// length; pdfSolidAngle: of the direction to x_k. Backwards the density is that of a hemisphere.
RL_FN bool pathIsWide(RL_IN(PathConnector) before, float geometry, float d2, float pdfSolidAngle) {
  if (!(gParams.path.footprint > 0.0f)) return true;
  float area = min(rlSafeDivide(1.0f, pdfSolidAngle * geometry), 6.2831853f * d2);
  return area >= gParams.path.footprint * before.footprint;
}

#ifdef RL_PATH_REPLAYS
// The predicate for the pair that a shift reconnects. end: pathEnd(path).
RL_FN bool pathReconnects(RL_IN(PathReplay) q, RL_IN(PathSample) path, RL_IN(LightSample) end) {
  if (pathEndsAtLight(path)) return true;
  vec3 d = end.point - q.x.posW;
  float pdf = bsdfPdf(q.x.bsdf, q.x.nGeoW, q.x.nShadeW, q.x.wo, normalize(d));
  return pathIsWide(q.before, shiftGeometryTerm(end.point, end.normal, q.x.posW), dot(d, d), pdf);
}
#endif

// The predicate for a vertex that the walk has reached.
RL_FN bool pathConnects(RL_IN(PathConnector) before, RL_IN(Walk) walk, RL_IN(Surface) s) {
  if (before.isRough == 0u || !pathIsRough(s)) return false;
  // Light that a medium scatters does not travel straight between the two.
  if (RL_HAS(RL_FEATURE_SCATTERING) && walk.isScattered != 0u) return false;
  vec3 d = s.posW - before.posW;
  return pathIsWide(before, shiftGeometryTerm(s.posW, s.nGeoW, before.posW), dot(d, d),
                    walk.pdfBsdf);
}
