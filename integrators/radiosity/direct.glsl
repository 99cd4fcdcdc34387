// Pass over chunks of the light samples of an unknown, once for the light of a scene: the
// irradiance that lights and ambient light give it, with shadow rays. Light samples are those of
// `path`.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  uint unknown = entry / gParams.lightChunks;
  if (unknown >= gParams.unknowns) return;
  Surface at = meshUnknown(unknown);
  Rng rng = rngInit(gFrame.seed, unknown, gFrame.frame);
  uint first = (entry % gParams.lightChunks) * RL_RADIOSITY_CHUNK;
  uint samples = gParams.lightChunks * RL_RADIOSITY_CHUNK;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  if (RL_HAS(RL_FEATURE_AMBIENT))
    sum += gScene.ambient * (float(RL_RADIOSITY_CHUNK) / (float(samples) * RL_INV_PI));
  for (uint i = 0u; i < RL_RADIOSITY_CHUNK; i = i + 1u) {
    if (!lightExists()) break;
    Rng own = rng;
    own.vertex = RL_VERTEX_CANDIDATES + first + i;
    LightSample light = lightSample(own, lightReceiverAt(at));
    LightConnection c = lightConnect(light, at.posW);
    float cosine = dot(at.nShadeW, c.dirW);
    if (!(light.pdf > 0.0f) || !(cosine > 0.0f) || !(dot(at.nGeoW, c.dirW) > 0.0f)) continue;
    vec3 unshadowed = c.emitted * (cosine * c.geometry / (light.pdf * float(samples)));
    if (rlIsBlack(unshadowed)) continue;
    Ray ray = lightShadowRay(light, c, at.posW, at.nGeoW, at.posError);
    Hit hit = traceNoHit();
    sum += unshadowed * traceRay(ray, RL_RAY_SHADOW, 0u, hit);
  }
  if (!rlIsFinite3(sum)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    sum = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.directParts.data[entry] = sum;
}
