// Pass over chunks of the samples of an unknown, once for the light of a scene: the irradiance that
// lights and ambient light give it. As in `path`, light samples with shadow rays and
// cosine-weighted rays that find lights go together by the power heuristic: next to a lamp the
// latter alone have little noise. Light samples are those of `path`. Draws do not depend on the
// frame: a lamp that is switched twice leaves no trace.
#include "integrators/radiosity/mesh.glsl"

// Light that a ray of the hemisphere found, times cosine over density, with its weight.
RL_FN vec3 directFound(RL_IN(Surface) at, RL_IN(Ray) ray, RL_IN(Hit) hit, float pdf) {
  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  float pdfLight = 0.0f;
  if (hit.instance == RL_INVALID) {
    if (!skyExists(false)) return radiance;
    radiance = skyRadiance(ray.dir, false);
    pdfLight = lightPdfOfEnvironment(ray.dir);
  } else {
    Surface s = surfaceLoad(hit, ray.dir);
    if (rlIsBlack(s.emission)) return radiance;
    radiance = s.emission;
    if (s.light != RL_INVALID)
      pdfLight = lightPdfOfHit(s.light, s.id, lightReceiverAt(at), s.nGeoW, ray.dir, hit.t);
  }
  return radiance * (lightMisWeight(pdf, pdfLight) / RL_INV_PI);
}

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  uint unknown = entry / gParams.lightChunks;
  if (unknown >= gParams.unknowns) return;
  Surface at = meshUnknown(unknown);
  Rng rng = rngInit(gFrame.seed, unknown, 0u);
  uint first = (entry % gParams.lightChunks) * RL_RADIOSITY_CHUNK;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  // Two rays a sample: to a light and into the hemisphere.
  for (uint turn = 0u; turn < 2u * RL_RADIOSITY_CHUNK; turn = turn + 1u) {
    uint i = turn / 2u;
    bool isToLight = (turn & 1u) == 0u;
    Rng own = rng;
    own.vertex = RL_VERTEX_CANDIDATES + first + i;
    Ray ray;
    vec3 unshadowed = vec3(0.0f, 0.0f, 0.0f);
    float pdf = 0.0f;
    bool traces = false;
    if (isToLight) {
      if (!lightExists()) continue;
      LightSample light = lightSample(own, lightReceiverAt(at));
      LightConnection c = lightConnect(light, at.posW);
      float cosine = dot(at.nShadeW, c.dirW);
      if (light.pdf > 0.0f && cosine > 0.0f && dot(at.nGeoW, c.dirW) > 0.0f) {
        float weight = c.isDelta ? 1.0f : lightMisWeight(c.pdfSolidAngle, cosine * RL_INV_PI);
        unshadowed = c.emitted * (cosine * c.geometry * weight / light.pdf);
      }
      traces = !rlIsBlack(unshadowed);
      ray = lightShadowRay(light, c, at.posW, at.nGeoW, at.posError);
    } else {
      // One ray in each of four by four strata.
      float u = rngDraw(own, RL_DIM_FILTER_X);
      float v = rngDraw(own, RL_DIM_FILTER_Y);
      vec2 strata = vec2(float(i % 4u) + u, float(i / 4u) + v) * 0.25f;
      ray.dir = frameToWorld(at.nShadeW, warpCosineHemisphere(strata));
      ray.origin = surfaceOffset(at.posW, at.nGeoW, at.posError, ray.dir);
      ray.tMin = 0.0f;
      ray.tMax = 3.0e38f;
      pdf = dot(ray.dir, at.nShadeW) * RL_INV_PI;
      // A smooth normal's hemisphere reaches below the face.
      traces = dot(ray.dir, at.nGeoW) > 0.0f && pdf > 0.0f;
    }
    if (!traces) continue;
    Hit hit = traceNoHit();
    uint key = isToLight ? 0u : rngHash(own.key.x + (first + i) * 0x85ebca6bu);
    float passed = traceRay(ray, isToLight ? RL_RAY_SHADOW : RL_RAY_PATH, key, hit);
    if (isToLight)
      sum += unshadowed * passed;
    else
      sum += directFound(at, ray, hit, pdf);
  }
  sum = sum * (1.0f / float(gParams.lightChunks * RL_RADIOSITY_CHUNK));
  if (RL_HAS(RL_FEATURE_AMBIENT))
    sum += gScene.ambient * (1.0f / (RL_INV_PI * float(gParams.lightChunks)));
  if (!rlIsFinite3(sum)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    sum = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.directParts.data[entry] = sum;
}
