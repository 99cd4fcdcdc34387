// What the reuse loop asks about samples: the bridge for both payloads.

RL_FN real bridgeTarget(RL_IN(real3) f) { return rlLuminance(f); }

// The same point of the same surface, seen from the same side. Of two faces that coincide, the
// material tells.
RL_FN bool bridgeIsSameAnchor(RL_IN(Anchor) a, RL_IN(Anchor) b) {
  if (!(a.posW == b.posW && a.wo == b.wo && a.nShadeW == b.nShadeW &&
        a.bsdf.diffuse == b.bsdf.diffuse))
    return false;
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return true;
  return a.bsdf.f0 == b.bsdf.f0 && a.bsdf.f90 == b.bsdf.f90 && a.bsdf.alpha == b.bsdf.alpha &&
         a.bsdf.lobes == b.bsdf.lobes;
}

// A light sample lives in the measure of its light (area, solid angle of the environment,
// discrete): receivers share it, the Jacobian is 1.
RL_FN real3 bridgeShift(RL_IN(LightReservoir) r, RL_IN(Anchor) from, RL_IN(Anchor) to,
                        RL_OUT(real) jacobian) {
  jacobian = real(1.0f);
  LightConnection c = lightConnect(r.light, to.posW);
  vec3 f = bsdfEval(to.bsdf, to.nGeoW, to.nShadeW, to.wo, c.dirW);
  return f * c.emitted * c.geometry;
}

// The radiance that x2 sends towards a point, without visibility, zero on its other side.
RL_FN vec3 pathRadianceTowards(RL_IN(PathVertex) v, RL_IN(PathSuffix) suffix,
                               RL_IN(vec3) dirFromX2) {
  if (!(dot(v.nGeoW, dirFromX2) > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  if (!RL_HAS(RL_FEATURE_GLOSSY) || v.kind == RL_PATH_LAMBERT) return v.radiance;
  vec3 f = bsdfEval(suffix.bsdf, v.nGeoW, suffix.nShadeW, dirFromX2, suffix.wi);
  if (rlIsBlack(f)) return f;
  // BSDF and MIS weight at x2 belong to the direction: a stored weight would break the partition.
  float weight = 1.0f;
  float pdfBsdf = 0.0f;
  if (suffix.pdfLight > 0.0f)
    pdfBsdf = bsdfPdf(suffix.bsdf, v.nGeoW, suffix.nShadeW, dirFromX2, suffix.wi);
  if (v.kind == RL_PATH_LIGHT) {
    if (suffix.pdfLight > 0.0f) weight = lightMisWeight(suffix.pdfLight, pdfBsdf);
    return f * v.radiance * weight;
  }
  if (suffix.pdfLight > 0.0f) weight = lightMisWeight(pdfBsdf, suffix.pdfLight);
  return f * (v.radiance + suffix.emitted * weight);
}

// Reconnection at x2.
RL_FN real3 bridgeShift(RL_IN(PathReservoir) r, RL_IN(Anchor) from, RL_IN(Anchor) to,
                        RL_OUT(real) jacobian) {
  real3 zero = real3(real(0.0f));
  jacobian = shiftReconnectionJacobian(r.vertex.posW, r.vertex.nGeoW, from.posW, to.posW);
  if (!(jacobian > 0.0f) || !rlIsFinite(jacobian)) {
    RL_HEALTH(RL_HEALTH_REJECTED_JACOBIAN);
    jacobian = real(1.0f);
    return zero;
  }
  if (max(jacobian, 1.0f / jacobian) > gParams.maxJacobian) {
    RL_HEALTH(RL_HEALTH_REJECTED_JACOBIAN);
    return zero;
  }
  vec3 d = normalize(r.vertex.posW - to.posW);
  vec3 radiance = pathRadianceTowards(r.vertex, r.suffix, -d);
  if (rlIsBlack(radiance)) return zero;
  return bsdfEval(to.bsdf, to.nGeoW, to.nShadeW, to.wo, d) * radiance;
}

// The shadow ray between a sample and an anchor.
RL_FN Ray bridgeSegment(RL_IN(LightReservoir) r, RL_IN(Anchor) at) {
  LightConnection c = lightConnect(r.light, at.posW);
  return lightShadowRay(r.light, c, at.posW, at.nGeoW, at.posError);
}

RL_FN Ray bridgeSegment(RL_IN(PathReservoir) r, RL_IN(Anchor) at) {
  Ray ray;
  vec3 d = r.vertex.posW - at.posW;
  ray.origin = surfaceOffset(at.posW, at.nGeoW, at.posError, d);
  ray.tMin = 0.0f;
  ray.dir = surfaceOffset(r.vertex.posW, r.vertex.nGeoW, r.vertex.posError, -d) - ray.origin;
  ray.tMax = 1.0f;
  return ray;
}

// Lambert parts scale with albedo; a glossy anchor's ratio is taken of diffuse + specular
// reflectance.
RL_FN real3 bridgeReflectanceRatio(RL_IN(Anchor) from, RL_IN(Anchor) to) {
  vec3 a = from.bsdf.diffuse;
  vec3 b = to.bsdf.diffuse;
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    a += from.bsdf.f0;
    b += to.bsdf.f0;
  }
  vec3 ratio = vec3(rlSafeDivide(b.x, a.x), rlSafeDivide(b.y, a.y), rlSafeDivide(b.z, a.z));
  float bound = gParams.maxReflectanceRatio;
  return min(ratio, vec3(bound, bound, bound));
}
