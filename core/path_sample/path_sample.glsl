// Path samples: what their words say, and reconnection to another x1.

RL_FN uint pathKind(RL_IN(PathSample) p) { return p.kind & RL_PATH_KIND_MASK; }
// Returns whether a path ends at a light behind x1.
RL_FN bool pathEndsAtLight(RL_IN(PathSample) p) {
#ifdef RL_PATH_REPLAYS
  return pathKind(p) == RL_PATH_DIRECT || pathKind(p) == RL_PATH_WEIGHED;
#else
  return pathKind(p) == RL_PATH_DIRECT;
#endif
}
RL_FN uint pathLightKind(RL_IN(PathSample) p) {
  return (p.kind >> RL_PATH_LIGHT_KIND_SHIFT) & RL_PATH_LIGHT_KIND_MASK;
}

// A direction and a density as the words of a reservoir hold them. A path is evaluated with these
// from its first evaluation on, so that every evaluation agrees.
RL_FN vec3 pathPackedWi(RL_IN(vec3) wi) {
  uvec2 words = packUnit22(wi);
  return unpackUnit22(words.x, words.y);
}
RL_FN float pathPackedPdf(float pdf) { return uintBitsToFloat(packCut(pdf, 16u) << 16u); }

// Returns whether targets are unshadowed: the one sample that is shown is traced instead.
RL_FN bool pathHasUnshadowedTarget() {
#ifdef RL_DIRECT_ONLY
  return gParams.path.unshadowedTarget != 0u;
#else
  return false;
#endif
}

// Target function of the resampling algebra.
RL_FN real reuseTarget(RL_IN(real3) f) { return rlLuminance(f); }

#ifdef RL_DIRECT_ONLY
#include "core/path_sample/direct_sample.glsl"
#else
RL_FN PathSample pathOfLight(RL_IN(LightSample) light, uint film) {
  PathSample p;
  p.id = light.id;
  p.kind = RL_PATH_DIRECT | (light.kind << RL_PATH_LIGHT_KIND_SHIFT);
  if (light.isTwoSided != 0u) p.kind = p.kind | RL_PATH_TWO_SIDED;
  p.film = film;
  p.radiance = light.radiance;
  p.geometry = 0.0f;
  p.wi = vec3(0.0f, 0.0f, 1.0f);
  p.pdfLight = 0.0f;
  p.base = 0u;
  p.key = 0u;
  if (light.kind == RL_LIGHT_ENVIRONMENT) {
    p.wi = pathPackedWi(light.point);
  } else if (light.kind != RL_LIGHT_AREA) {
    p.id.instance = light.record;
  }
  return p;
}

// The end of the segment from x1: the light, or x2 as if it were one, which shines to x1's side.
RL_FN LightSample pathEnd(RL_IN(PathSample) p) {
  bool isLight = pathEndsAtLight(p);
  LightSample end;
  end.id = p.id;
  end.kind = isLight ? pathLightKind(p) : RL_LIGHT_AREA;
  end.point = p.wi;  // of the environment
  end.normal = vec3(0.0f, 0.0f, 0.0f);
  end.pdf = 0.0f;
  end.radiance = p.radiance;
  end.posError = 0.0f;
  end.cone = vec2(0.0f, 0.0f);
  end.isTwoSided = isLight ? p.kind & RL_PATH_TWO_SIDED : 0u;
  end.record = RL_INVALID;
  if (end.kind == RL_LIGHT_AREA) {
    SurfacePoint at = surfacePointAt(p.id);
    end.point = at.posW;
    end.posError = at.posError;
    end.normal = at.normalW;
    if (!isLight && (p.kind & RL_PATH_BACK) != 0u) end.normal = -end.normal;
    // Surfaces of bodies that touch lie within so much (core/transport/media.glsl).
    if (RL_HAS(RL_FEATURE_VOLUME) && gScene.bodiesMeet != 0u) end.posError *= 3.0f;
  }
  if (RL_HAS(RL_FEATURE_PUNCTUAL_LIGHTS) && isLight && end.kind != RL_LIGHT_AREA &&
      end.kind != RL_LIGHT_ENVIRONMENT) {
    end.record = p.id.instance;
    Light light = recordLight(end.record);
    end.point = light.p0;
    if (end.kind == RL_LIGHT_DIRECTIONAL) end.point = -light.e1;
    if (end.kind == RL_LIGHT_POINT) end.normal = light.e2;
    if (end.kind == RL_LIGHT_SPOT) {
      end.normal = light.e1;
      end.cone = vec2(light.e2.x, light.e2.y);
    }
  }
  return end;
}

#endif

// Radiance that x2 sends towards a point on x1's side, without visibility. BSDF and MIS weight at
// x2 are evaluated for this direction: stored MIS weights would not sum to one.
RL_FN vec3 pathRadianceTowards(RL_IN(PathSample) p, RL_IN(vec3) dirFromX2) {
  if (!RL_HAS(RL_FEATURE_GLOSSY) || pathKind(p) == RL_PATH_LAMBERT) return p.radiance;
  Surface x2 = surfaceAt(p.id, dirFromX2);
  float pdfBsdf;
  vec3 f = bsdfEvalAndPdf(x2.bsdf, x2.nGeoW, x2.nShadeW, x2.wo, p.wi, pdfBsdf);
  float weight = 1.0f;
  if (p.pdfLight > 0.0f) {
    weight = pathKind(p) == RL_PATH_LIGHT_SAMPLE ? lightMisWeight(p.pdfLight, pdfBsdf)
                                                 : lightMisWeight(pdfBsdf, p.pdfLight);
  }
  return f * p.radiance * weight;
}

// MIS weight of a light sample at a smooth x1.
RL_FN float pathSmoothWeight(RL_IN(PathSample) p, RL_IN(Surface) x1, RL_IN(LightConnection) c,
                             float pdfBsdf) {
  if (c.isDelta) return 1.0f;
  if (pathLightKind(p) == RL_LIGHT_ENVIRONMENT)
    return lightMisWeight(lightPdfOfEnvironment(c.dirW), pdfBsdf);
  Instance inst = recordInstance(p.id.instance);
  bool isShape = RL_HAS_SHAPES && shapeIs(recordGeometry(inst.geometry));
  uint record = surfaceLight(inst, isShape, p.id.primitive);
  float perArea = lightPdfPerArea(record, p.id, lightReceiverAt(x1));
  return lightMisWeight(perArea * rlSafeDivide(1.0f, c.geometry), pdfBsdf);
}

// Segment from x1 (position, geometric normal, error of the position) to the end of a path, as a
// shadow ray.
RL_FN Ray pathSegment(RL_IN(LightSample) end, RL_IN(vec3) x1PosW, RL_IN(vec3) x1NGeoW,
                      float x1PosError) {
  return lightShadowRay(end, lightConnect(end, x1PosW), x1PosW, x1NGeoW, x1PosError);
}

// Shifts a path to another x1, without the visibility of its segment. Direct light is in the
// measure of its light (area, solid angle of the environment, discrete), which all pixels share:
// J = 1. For a vertex x2, J is the ratio of geometry terms; outside [1 / maxJacobian, maxJacobian]
// the shift is undefined, both ways (Lin et al. 2022). end: pathEnd(p). failed: the reason where F
// is black.
RL_FN Shifted pathReconnect(RL_IN(PathSample) p, RL_IN(LightSample) end, RL_IN(Surface) x1,
                            real maxJacobian, RL_OUT(uint) failed) {
  failed = RL_FAILED_DARK;
  Shifted s;
  s.F = real3(real(0.0f));
  s.jacobian = real(1.0f);
  if (pathEndsAtLight(p)) {
    LightConnection c = lightConnect(end, x1.posW);
    float pdfBsdf;
    vec3 f = bsdfEvalAndPdf(x1.bsdf, x1.nGeoW, x1.nShadeW, x1.wo, c.dirW, pdfBsdf);
    s.F = f * c.emitted * c.geometry;
#ifdef RL_PATH_REPLAYS
    if (pathKind(p) == RL_PATH_WEIGHED) s.F *= pathSmoothWeight(p, x1, c, pdfBsdf);
#endif
    return s;
  }
  real geometry = shiftGeometryTerm(end.point, end.normal, x1.posW);
  real jacobian = rlSafeDivide(geometry, p.geometry);
  if (!(jacobian > 0.0f) || !rlIsFinite(jacobian) || max(jacobian, 1.0f / jacobian) > maxJacobian) {
    RL_HEALTH(RL_HEALTH_REJECTED_JACOBIAN);
    failed = RL_FAILED_JACOBIAN;
    return s;
  }
  vec3 d = normalize(end.point - x1.posW);
  if (!(dot(end.normal, -d) > 0.0f)) return s;
  vec3 radiance = pathRadianceTowards(p, -d);
  if (rlIsBlack(radiance)) return s;
  s.jacobian = jacobian;
  s.F = bsdfEval(x1.bsdf, x1.nGeoW, x1.nShadeW, x1.wo, d) * radiance;
  return s;
}
