// Light samples of a point: drawn from all lights, or one of each.

// One of each, where there are no more lights than light samples.
RL_FN bool localTakesEach() {
  return gParams.lightSamples == 0u && gScene.lightCount <= RL_LOCAL_MOST_RAYS;
}

RL_FN uint localLightCount(uint events) {
  if (!lightExists()) return 0u;
  if (localTakesEach()) return gScene.lightCount;
  if (events != 0u) return 1u;
  return gParams.lightSamples == 0u ? RL_LOCAL_MOST_RAYS : gParams.lightSamples;
}

// A light sample of one light: lightSample() without its choice. A density of 0: it is off.
RL_FN LightSample localSampleOf(RL_IN(Rng) rng, uint record, RL_IN(LightReceiver) receiver) {
  Light light = recordLight(record);
  light.pmf = rlIsBlack(light.radiance) ? 0.0f : 1.0f;
  if (light.kind == RL_LIGHT_ENVIRONMENT) light.pmf = 1.0f;
  uint uBits = rngBits(rng, RL_DIM_LIGHT_U);
  uint vBits = rngBits(rng, RL_DIM_LIGHT_V);
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
  if (light.pmf > 0.0f) lightTellDrawn(record);
  LightSample s = lightPoint(record, light, primitive, bary, dirW);
  if (isShape) s.pdf *= shapeLightDensity(s.id, receiver.posW);
  if (RL_HAS(RL_FEATURE_ENVIRONMENT) && light.kind == RL_LIGHT_ENVIRONMENT) s.pdf *= density;
  return s;
}

// The light sample of one number.
RL_FN LightSample localLightSample(RL_IN(Rng) rng, uint number, RL_IN(LightReceiver) receiver) {
  if (localTakesEach()) return localSampleOf(rng, number, receiver);
  return lightSample(rng, receiver);
}

// Random numbers of a ray: of a light sample, or of occlusion. Beyond the first vertex there is one
// of each a point, unless each light has one.
RL_FN Rng localRng(RL_IN(Rng) rng, uint events, uint point, uint ray, bool isOcclusion) {
  uint place = (events * 3u + point) * 2u + (isOcclusion ? 1u : 0u);
  uint number = 6u * RL_LOCAL_MOST_RAYS + place;
  if (events == 0u || localTakesEach()) number = place * RL_LOCAL_MOST_RAYS + ray;
  Rng own = rng;
  own.vertex = RL_VERTEX_CANDIDATES + number;
  return own;
}
