// Lights: one table of emissive triangles, punctual lights and the environment, selected by power
// within each kind (core/scene/compiled/light_table.h).
//   lightSample    draws a point of a light
//   lightPoint     a point of a light that is named
//   lightConnect   evaluates a drawn light for a receiver
//   lightReceiverAt  where light arrives: lamps may be chosen by it (core/shading/light/tree.glsl)
//   lightPdf...    density with which lightSample would have drawn the light that a ray has found

// Selects a light by the alias method: 32 bits for the column and 32 for the threshold.
RL_FN uint lightAt(uint columnBits, uint aliasBits) {
  uint i = rlMulHigh(columnBits, gScene.lightCount);
  AliasEntry entry = recordAlias(RL_SCENE_UVEC3(gScene.lightAlias, i));
  return aliasBits < entry.keep ? i : entry.other;
}

RL_FN uint lightSelect(RL_IN(Rng) rng) {
  uint columnBits = rngBits(rng, RL_DIM_LIGHT_SELECT);
  uint aliasBits = rngBits(rng, RL_DIM_LIGHT_ALIAS);
  return lightAt(columnBits, aliasBits);
}

// Selects a light for a receiver, with its probability. 0: a lamp that sends it no light.
RL_FN uint lightDraw(RL_IN(Rng) rng, RL_IN(LightReceiver) receiver, RL_OUT(float) probability) {
  uint record = 0u;
  if (!lightTreeIsUsed() || gScene.lampShare < 1.0f) {
    record = lightSelect(rng);
    Light light = recordLight(record);
    probability = light.pmf;
    if (!lightTreeIsUsed() || !lightIsLamp(light.kind)) return record;
  }
  uint lamp = lightTreeDraw(rng, receiver, probability);
  probability *= gScene.lampShare;
  return lamp != RL_INVALID ? lamp : record;
}

// Marks a light for FrameData::drawnLights.
RL_FN void lightTellDrawn(uint record) {
  if (!RL_IS_NULL(gFrame.drawnLights)) RL_MARK(gFrame.drawnLights, record);
}

RL_FN bool lightExists() { return gScene.lightCount != 0u; }

RL_FN bool lightIsShape(RL_IN(Light) light) {
  return RL_HAS_SHAPES && light.kind == RL_LIGHT_AREA && (light.flags & RL_LIGHT_SHAPE) != 0u;
}

// A point of a light. `primitive` and `bary` name it on a surface; `dirW`: to the environment. The
// density is per area (surfaces), discrete else: that of a direction to the environment and of a
// point of a shape is left to the caller.
RL_FN LightSample lightPoint(uint record, RL_IN(Light) light, uint primitive, RL_IN(vec2) bary,
                             RL_IN(vec3) dirW) {
  LightSample s;
  s.record = record;
  s.kind = light.kind;
  s.point = light.p0;
  s.normal = vec3(0.0f, 0.0f, 0.0f);
  s.pdf = light.pmf;
  s.radiance = light.radiance;
  s.posError = 0.0f;
  s.cone = vec2(light.e2.x, light.e2.y);
  if (light.kind == RL_LIGHT_SPOT) s.normal = light.e1;
  if (RL_HAS(RL_FEATURE_PUNCTUAL_LIGHTS) && light.kind == RL_LIGHT_POINT) s.normal = light.e2;
  s.isTwoSided = 0u;
  s.id.instance = light.instance;
  s.id.primitive = primitive;
  s.id.bary = bary;
  if (RL_HAS(RL_FEATURE_AREA_LIGHTS) && light.kind == RL_LIGHT_AREA) {
    if (lightIsShape(light)) {
      SurfacePoint p = surfacePointAt(s.id);
      s.point = p.posW;
      s.normal = p.normalW;
      s.posError = p.posError;
    } else {
      s.point = light.p0 + bary.x * light.e1 + bary.y * light.e2;
      s.normal = normalize(cross(light.e1, light.e2));
      if ((light.flags & RL_LIGHT_FLIPPED) != 0u) s.normal = -s.normal;
      s.pdf = light.pmf * light.areaInverse;
      s.posError = RL_HIT_ERROR * light.magnitude;
    }
    s.isTwoSided = light.flags & RL_MATERIAL_DOUBLE_SIDED;
    if (RL_HAS(RL_FEATURE_EMISSIVE_TEXTURES)) s.radiance = s.radiance * lightTexture(s.id);
    if (RL_HAS(RL_FEATURE_ALPHA)) {
      // Path rays meet a partly transparent emitter with probability alpha.
      Hit hit;
      hit.instance = light.instance;
      hit.primitive = primitive;
      hit.bary = bary;
      hit.t = 0.0f;
      s.radiance = s.radiance * surfaceAlpha(hit);
    }
  }
  if (RL_HAS(RL_FEATURE_PUNCTUAL_LIGHTS) && light.kind == RL_LIGHT_DIRECTIONAL) s.point = -light.e1;
  if (RL_HAS(RL_FEATURE_ENVIRONMENT) && light.kind == RL_LIGHT_ENVIRONMENT) {
    s.point = dirW;
    s.radiance = environmentRadiance(dirW);
  }
  return s;
}

// Where light arrives that is scattered at a surface.
RL_FN LightReceiver lightReceiverAt(RL_IN(Surface) s) {
  LightReceiver receiver;
  receiver.posW = s.posW;
  receiver.normalW = s.nGeoW;
  receiver.isTwoSided = bsdfIsTwoSided(s.bsdf) ? 1u : 0u;
  return receiver;
}

// Requires lightExists(). A density of 0: the receiver drew a lamp that sends it no light.
RL_FN_OUTLINE LightSample lightSample(RL_IN(Rng) rng, RL_IN(LightReceiver) receiver) {
  uint uBits = rngBits(rng, RL_DIM_LIGHT_U);
  uint vBits = rngBits(rng, RL_DIM_LIGHT_V);
  float pmf = 0.0f;
  uint record = lightDraw(rng, receiver, pmf);
  if (pmf > 0.0f) lightTellDrawn(record);
  Light light = recordLight(record);
  light.pmf = pmf;
  vec2 bary = vec2(rngUnit(uBits), rngUnit(vBits));
  vec3 dirW = vec3(0.0f, 0.0f, 0.0f);
  float density = 1.0f;
  uint primitive = light.primitive;
  bool isShape = lightIsShape(light);
  if (isShape) {
    SurfaceId id = shapeLightDraw(light.instance, receiver.posW, bary);
    primitive = id.primitive;
    bary = id.bary;
  } else if (RL_HAS(RL_FEATURE_AREA_LIGHTS) && light.kind == RL_LIGHT_AREA) {
    bary = warpTriangle(bary);
  }
  if (RL_HAS(RL_FEATURE_ENVIRONMENT) && light.kind == RL_LIGHT_ENVIRONMENT) {
    uint aliasBits = rngBits(rng, RL_DIM_ENVIRONMENT_ALIAS);
    dirW = environmentDraw(uvec2(uBits, vBits), aliasBits, density);
  }
  LightSample s = lightPoint(record, light, primitive, bary, dirW);
  if (isShape) s.pdf *= shapeLightDensity(s.id, receiver.posW);
  if (RL_HAS(RL_FEATURE_ENVIRONMENT) && light.kind == RL_LIGHT_ENVIRONMENT) s.pdf *= density;
  return s;
}

RL_FN LightConnection lightConnect(RL_IN(LightSample) s, RL_IN(vec3) posW) {
  LightConnection c;
  c.isDelta = false;
  c.geometry = 1.0f;
  c.distance = 0.0f;
  c.emitted = s.radiance;
  c.dirW = s.point;
  c.pdfSolidAngle = s.pdf;
  if (s.kind == RL_LIGHT_ENVIRONMENT) return c;
  if (s.kind == RL_LIGHT_DIRECTIONAL) {
    c.isDelta = true;
    c.pdfSolidAngle = 0.0f;
    return c;
  }
  vec3 d = s.point - posW;
  float d2 = dot(d, d);
  c.distance = sqrt(d2);
  c.dirW = d * rlSafeDivide(1.0f, c.distance);
  if (s.kind == RL_LIGHT_AREA) {
    float cosLight = -dot(s.normal, c.dirW);
    if (s.isTwoSided != 0u) cosLight = abs(cosLight);
    if (!(cosLight > 0.0f) || !(d2 > 0.0f)) {
      c.emitted = vec3(0.0f, 0.0f, 0.0f);
      c.geometry = 0.0f;
      c.pdfSolidAngle = 0.0f;
      return c;
    }
    c.geometry = cosLight / d2;
    c.pdfSolidAngle = s.pdf / c.geometry;
    return c;
  }
  c.isDelta = true;
  c.pdfSolidAngle = 0.0f;
  float fall = d2;
  if (s.kind == RL_LIGHT_POINT) fall = s.normal.x + s.normal.y * c.distance + s.normal.z * d2;
  c.emitted = c.emitted * rlSafeDivide(1.0f, fall);
  if (s.kind == RL_LIGHT_SPOT) {
    float falloff = clamp(-dot(c.dirW, s.normal) * s.cone.x + s.cone.y, 0.0f, 1.0f);
    c.emitted = c.emitted * (falloff * falloff);
  }
  return c;
}

// The shadow ray of a connection: origin to target with tMax 1, both ends moved off their surfaces.
RL_FN Ray lightShadowRay(RL_IN(LightSample) s, RL_IN(LightConnection) c, RL_IN(vec3) posW,
                         RL_IN(vec3) nGeoW, float posError) {
  Ray ray;
  ray.origin = surfaceOffset(posW, nGeoW, posError, c.dirW);
  ray.tMin = 0.0f;
  if (c.distance > 0.0f) {
    vec3 target = s.point;
    if (s.kind == RL_LIGHT_AREA) {
      target = surfaceSegmentEnd(s.point, s.normal, s.posError, posError, -c.dirW);
    }
    ray.dir = target - ray.origin;
    ray.tMax = 1.0f;
  } else {
    ray.dir = c.dirW;
    ray.tMax = 3.0e38f;
  }
  return ray;
}

// Density per area with which lightSample finds a point of a surface that emits.
RL_FN float lightPdfPerArea(uint record, RL_IN(SurfaceId) id, RL_IN(LightReceiver) receiver) {
  Light light = recordLight(record);
  float ofLight = lightProbability(record, light, receiver);
  if (lightIsShape(light)) return ofLight * shapeLightDensity(id, receiver.posW);
  return ofLight * light.areaInverse;
}

// Solid-angle density with which lightSample finds the emitting surface that a path ray has hit.
RL_FN float lightPdfOfHit(uint record, RL_IN(SurfaceId) id, RL_IN(LightReceiver) receiver,
                          RL_IN(vec3) nGeoW, RL_IN(vec3) dirW, float distance) {
  float cosLight = abs(dot(nGeoW, dirW));
  if (!(cosLight > 0.0f)) return 0.0f;
  float perArea = lightPdfPerArea(record, id, receiver);
  return perArea * distance * distance / cosLight;
}

// Solid-angle density with which lightSample finds the environment in a direction.
RL_FN float lightPdfOfEnvironment(RL_IN(vec3) dirW) {
  if (gScene.environmentLight == RL_INVALID) return 0.0f;
  return recordLight(gScene.environmentLight).pmf * environmentPdf(dirW);
}

// Weight of a technique with density p against one with density q (power heuristic, exponent 2).
RL_FN float lightMisWeight(float p, float q) {
  // Scale by the larger density: squares of densities overflow float32 for small lights.
  float m = max(p, q);
  if (!(m > 0.0f)) return 0.0f;
  float a = p / m;
  float b = q / m;
  return a * a / (a * a + b * b);
}
