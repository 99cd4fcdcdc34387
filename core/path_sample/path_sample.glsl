// Path samples in reservoirs: layout in buffers, and reconnection to another x1.

RL_FN bool pathIsSpot(uint kind) {
  return (kind & RL_PATH_KIND_MASK) == RL_PATH_DIRECT &&
         ((kind >> RL_PATH_LIGHT_SHIFT) & RL_PATH_LIGHT_MASK) == RL_LIGHT_SPOT;
}

// Writes the state and, of the path, only its radiance, which is stored with the state.
RL_FN void pathStateWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(PathReservoir) r) {
  reservoirStateWrite(words, at + RL_PATH_SAMPLE_UVEC4S, r.state, packPositive3(r.path.radiance));
}

// Writes path and state. Position, film sample and geometry are exact, and the normal to rounding.
// A spot light has no geometry: its index in the light table is stored instead.
RL_FN void pathReservoirWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(PathReservoir) r) {
  uvec2 normal = packUnit(r.path.normalW);
  uint geometry = floatBitsToUint(r.path.geometry);
  if (pathIsSpot(r.path.kind)) geometry = r.path.light;
  RL_WRITE_UVEC4(words, at, recordUvec4(r.path.posW, r.path.film));
  RL_WRITE_UVEC4(words, at + 1u,
                 uvec4(normal.x, normal.y, geometry, packAtLeast24(r.path.posError, r.path.kind)));
  pathStateWrite(words, at, r);
}

RL_FN ReservoirState pathStateRead(RL_IN(Uvec4Ref) words, uint at) {
  uvec2 radiance;
  return reservoirStateRead(words, at + RL_PATH_SAMPLE_UVEC4S, radiance);
}

// Reads path and state. Keeps r's suffix.
RL_FN void pathReservoirRead(RL_IN(Uvec4Ref) words, uint at, RL_INOUT(PathReservoir) r) {
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  uvec2 radiance;
  r.state = reservoirStateRead(words, at + RL_PATH_SAMPLE_UVEC4S, radiance);
  r.path.posW = recordVec3(q0);
  r.path.film = q0.w;
  r.path.normalW = unpackUnit(q1.x, q1.y);
  r.path.radiance = unpackPositive3(radiance.x, radiance.y);
  r.path.kind = q1.w & 0xffu;
  r.path.posError = unpack24(q1.w);
  bool isSpot = pathIsSpot(r.path.kind);
  r.path.light = isSpot ? q1.z : RL_INVALID;
  r.path.geometry = isSpot ? 0.0f : uintBitsToFloat(q1.z);
}

// Suffixes are stored only if the scene has glossy lobes.
RL_FN void pathSuffixWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(PathSuffix) s) {
  uvec2 nShade = packUnit(s.nShadeW);
  uvec2 wi = packUnit(s.wi);
  uvec2 emitted = packPositive3(s.emitted);
  RL_WRITE_UVEC4(words, at, uvec4(nShade.x, nShade.y, wi.x, wi.y));
  bsdfWrite(words, at + 1u, s.bsdf, uvec3(emitted.x, emitted.y, floatBitsToUint(s.pdfLight)));
}
RL_FN PathSuffix pathSuffixRead(RL_IN(Uvec4Ref) words, uint at) {
  uvec4 q = RL_EARLIER_UVEC4(words, at);
  uvec3 rest;
  PathSuffix s;
  s.bsdf = bsdfRead(words, at + 1u, rest);
  s.nShadeW = unpackUnit(q.x, q.y);
  s.wi = unpackUnit(q.z, q.w);
  s.emitted = unpackPositive3(rest.x, rest.y);
  s.pdfLight = uintBitsToFloat(rest.z);
  return s;
}

// Target function of the resampling algebra.
RL_FN real reuseTarget(RL_IN(real3) f) { return rlLuminance(f); }

RL_FN PathSuffix pathNoSuffix() {
  PathSuffix s;
  s.nShadeW = vec3(0.0f, 0.0f, 1.0f);
  s.pdfLight = 0.0f;
  s.wi = vec3(0.0f, 0.0f, 1.0f);
  s.emitted = vec3(0.0f, 0.0f, 0.0f);
  s.bsdf = bsdfNone();
  return s;
}

RL_FN uint pathKind(RL_IN(PathSample) p) { return p.kind & RL_PATH_KIND_MASK; }

RL_FN PathSample pathOfLight(RL_IN(LightSample) light, uint film) {
  PathSample p;
  p.posW = light.point;
  p.posError = light.posError;
  p.normalW = light.normal;
  p.kind = RL_PATH_DIRECT | (light.kind << RL_PATH_LIGHT_SHIFT);
  if (light.isTwoSided != 0u) p.kind = p.kind | RL_PATH_TWO_SIDED;
  p.radiance = light.radiance;
  p.film = film;
  p.light = light.record;
  p.geometry = 0.0f;
  p.suffix = pathNoSuffix();
  return p;
}

RL_FN LightSample pathLight(RL_IN(PathSample) p) {
  LightSample light;
  light.point = p.posW;
  light.kind = (p.kind >> RL_PATH_LIGHT_SHIFT) & RL_PATH_LIGHT_MASK;
  light.normal = p.normalW;
  light.pdf = 0.0f;
  light.radiance = p.radiance;
  light.posError = p.posError;
  light.cone = vec2(0.0f, 0.0f);
  light.isTwoSided = p.kind & RL_PATH_TWO_SIDED;
  light.record = p.light;
  if (RL_HAS(RL_FEATURE_PUNCTUAL_LIGHTS) && light.kind == RL_LIGHT_SPOT) {
    Light spot = recordLight(p.light);
    light.normal = spot.e1;
    light.cone = vec2(spot.e2.x, spot.e2.y);
  }
  return light;
}

// Radiance that x2 sends towards a point, without visibility; zero on the other side of x2.
RL_FN vec3 pathRadianceTowards(RL_IN(PathSample) p, RL_IN(vec3) dirFromX2) {
  if (!(dot(p.normalW, dirFromX2) > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  if (!RL_HAS(RL_FEATURE_GLOSSY) || pathKind(p) == RL_PATH_LAMBERT) return p.radiance;
  PathSuffix suffix = p.suffix;
  // Evaluate BSDF and MIS weight at x2 for this direction: stored MIS weights would not sum to one.
  float pdfBsdf;
  vec3 f = bsdfEvalAndPdf(suffix.bsdf, p.normalW, suffix.nShadeW, dirFromX2, suffix.wi, pdfBsdf);
  if (rlIsBlack(f)) return f;
  float weight = 1.0f;
  if (pathKind(p) == RL_PATH_LIGHT) {
    if (suffix.pdfLight > 0.0f) weight = lightMisWeight(suffix.pdfLight, pdfBsdf);
    return f * p.radiance * weight;
  }
  if (suffix.pdfLight > 0.0f) weight = lightMisWeight(pdfBsdf, suffix.pdfLight);
  return f * (p.radiance + suffix.emitted * weight);
}

RL_FN real pathGeometry(RL_IN(PathSample) p, RL_IN(vec3) x1) {
  return shiftGeometryTerm(p.posW, p.normalW, x1);
}

// Segment from x1 (position, geometric normal, error of the position) to a vertex x2 or a light, as
// a shadow ray.
RL_FN Ray pathSegment(RL_IN(PathSample) p, RL_IN(vec3) x1PosW, RL_IN(vec3) x1NGeoW,
                      float x1PosError) {
  if (pathKind(p) == RL_PATH_DIRECT) {
    LightSample light = pathLight(p);
    return lightShadowRay(light, lightConnect(light, x1PosW), x1PosW, x1NGeoW, x1PosError);
  }
  Ray ray;
  vec3 d = p.posW - x1PosW;
  ray.origin = surfaceOffset(x1PosW, x1NGeoW, x1PosError, d);
  ray.tMin = 0.0f;
  ray.dir = surfaceSegmentEnd(p.posW, p.normalW, p.posError, x1PosError, -d) - ray.origin;
  ray.tMax = 1.0f;
  return ray;
}

// Shifts a path to another x1, without the visibility of its segment. Direct light is in the
// measure of its light (area, solid angle of the environment, discrete), which all pixels share:
// J = 1. For a vertex x2, J is the ratio of geometry terms; outside [1 / maxJacobian, maxJacobian]
// the shift is undefined, both ways (Lin et al. 2022).
RL_FN Shifted pathReconnect(RL_IN(PathSample) p, RL_IN(Surface) x1, real maxJacobian) {
  Shifted s;
  s.F = real3(real(0.0f));
  s.jacobian = real(1.0f);
  if (pathKind(p) == RL_PATH_DIRECT) {
    LightConnection c = lightConnect(pathLight(p), x1.posW);
    vec3 f = bsdfEval(x1.bsdf, x1.nGeoW, x1.nShadeW, x1.wo, c.dirW);
    s.F = f * c.emitted * c.geometry;
    return s;
  }
  real jacobian = rlSafeDivide(pathGeometry(p, x1.posW), p.geometry);
  if (!(jacobian > 0.0f) || !rlIsFinite(jacobian) || max(jacobian, 1.0f / jacobian) > maxJacobian) {
    RL_HEALTH(RL_HEALTH_REJECTED_JACOBIAN);
    return s;
  }
  vec3 d = normalize(p.posW - x1.posW);
  vec3 radiance = pathRadianceTowards(p, -d);
  if (rlIsBlack(radiance)) return s;
  s.jacobian = jacobian;
  s.F = bsdfEval(x1.bsdf, x1.nGeoW, x1.nShadeW, x1.wo, d) * radiance;
  return s;
}
