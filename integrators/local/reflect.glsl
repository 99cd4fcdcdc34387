// Reflection by the chosen model, and light that arrives from a light sample.

// f |cos_i| pi of the models that are formulas, over the albedo (diffuse) and on top of it.
RL_FN void localModelParts(RL_IN(Surface) s, RL_IN(vec3) dirW, RL_OUT(float) diffuse,
                           RL_OUT(float) highlight) {
  diffuse = 0.0f;
  highlight = 0.0f;
  float cosI = dot(s.nShadeW, dirW);
  if (!(cosI > 0.0f) || !(dot(s.nGeoW, dirW) > 0.0f)) return;
  diffuse = cosI;
  float cosLobe = 0.0f;
  if (gParams.model == RL_LOCAL_PHONG) cosLobe = dot(s.nShadeW * (2.0f * cosI) - dirW, s.wo);
  if (gParams.model == RL_LOCAL_BLINN_PHONG) {
    vec3 h = dirW + s.wo;
    cosLobe = dot(s.nShadeW, h) * rlSafeDivide(1.0f, sqrt(dot(h, h)));
  }
  if (cosLobe > 0.0f)
    highlight = gParams.highlight * pow(min(cosLobe, 1.0f), gParams.highlightPower);
}

// Albedo of those models. Light that reflections follow is not reflected diffusely as well.
RL_FN vec3 localModelAlbedo(RL_IN(Surface) s) {
  vec3 albedo = bsdfAlbedo(s.bsdf);
  if (gParams.reflections != 0u) albedo = s.bsdf.diffuse;
  return min(albedo, vec3(1.0f, 1.0f, 1.0f));
}

// f |cos_i| of the chosen model.
RL_FN vec3 localReflect(RL_IN(Surface) s, RL_IN(vec3) dirW) {
  if (gParams.model == RL_LOCAL_CLOSURE) {
    float pdf;
    return bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, dirW, pdf);
  }
  float diffuse;
  float highlight;
  localModelParts(s, dirW, diffuse, highlight);
  vec3 value = localModelAlbedo(s) * diffuse + vec3(highlight, highlight, highlight);
  return value * RL_INV_PI;
}

// The hit that names a point of a triangle.
RL_FN Hit localHitAt(uint instance, uint primitive, RL_IN(vec2) bary) {
  Hit hit = traceNoHit();
  hit.instance = instance;
  hit.primitive = primitive;
  hit.bary = bary;
  return hit;
}

// The part of its triangle that a surface lies in: weights at the part's corners, and the shares of
// these corners in the surface.
RL_FN LocalPart localPartOf(RL_IN(Surface) s) {
  uint edge = 1u << gParams.divisions;
  vec2 at = clamp(s.id.bary, vec2(0.0f, 0.0f), vec2(1.0f, 1.0f)) * float(edge);
  vec2 cell = min(floor(at), vec2(float(edge - 1u), float(edge - 1u)));
  vec2 inside = at - cell;
  LocalPart part;
  bool isTurned = inside.x + inside.y > 1.0f && cell.x + cell.y + 2.0f <= float(edge);
  float side = isTurned ? -1.0f : 1.0f;
  if (isTurned) {
    inside = vec2(1.0f, 1.0f) - inside;
    cell = cell + vec2(1.0f, 1.0f);
  }
  float scale = 1.0f / float(edge);
  part.corners[0] = cell * scale;
  part.corners[1] = (cell + vec2(side, 0.0f)) * scale;
  part.corners[2] = (cell + vec2(0.0f, side)) * scale;
  part.shares = vec3(max(1.0f - inside.x - inside.y, 0.0f), inside.x, inside.y);
  return part;
}

// The hit that names a point at which a surface is lit: a corner of its part, or its middle.
RL_FN Hit localPointHit(RL_IN(Surface) s, uint point) {
  LocalPart part = localPartOf(s);
  vec2 bary = part.corners[point];
  if (gParams.shading == RL_LOCAL_FLAT)
    bary = (part.corners[0] + part.corners[1] + part.corners[2]) * (1.0f / 3.0f);
  return localHitAt(s.id.instance, s.id.primitive, bary);
}

// Unit vector from a point to the eye, whose rays begin there or go along `dirW`.
RL_FN vec3 localToEye(RL_IN(vec3) posW, RL_IN(vec3) eyeW, RL_IN(vec3) dirW, bool isParallel) {
  vec3 toEye = isParallel ? -dirW : eyeW - posW;
  return toEye * rlSafeDivide(1.0f, sqrt(dot(toEye, toEye)));
}

// Light that arrives at a point from a light sample if nothing is in the way. `lights`: light
// samples of the point.
RL_FN vec3 localArrives(RL_IN(LightSample) light, RL_IN(LightConnection) c, uint lights) {
  if (!(light.pdf > 0.0f) || rlIsBlack(c.emitted)) return vec3(0.0f, 0.0f, 0.0f);
  float factor = c.geometry / light.pdf;
  if (!localTakesEach()) factor = factor / float(lights);
  return c.emitted * factor;
}

// Share of a light sample that passes what stands in its way; below 0: a shadow ray must tell.
RL_FN float localMapShadow(RL_IN(LightSample) light, RL_IN(Surface) at) {
  if (gParams.shadows == 0u) return 1.0f;
  if (gParams.shadows != RL_LOCAL_SHADOW_MAP) return -1.0f;
  uint lamp = localLampOf(light);
  return lamp == RL_INVALID ? -1.0f : localMapPassed(localLampRead(lamp), at.posW, at.nGeoW);
}
