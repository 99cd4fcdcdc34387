// Resampled importance sampling over one random surface per thread: random numbers, warps, GGX
// reflection and transmission, and the streaming reservoir, on files that every integrator uses.
#include "core/resampling/ris.glsl"

// Light from a direction: positive everywhere, with a bright cap. Only + and *, which all machines
// round alike.
RL_FN vec3 parityRadiance(RL_IN(vec3) dirW) {
  float up = 0.5f + 0.5f * dirW.y;
  float cap = up * up;
  cap = cap * cap;
  cap = cap * cap;
  return vec3(0.1f + 8.0f * cap, 0.2f + 4.0f * cap, 0.4f + 0.5f * dirW.x * dirW.x);
}

// Makes a surface from the thread's own random numbers: diffuse under a rough dielectric or
// metallic layer, every fourth one transmissive.
RL_FN Bsdf parityBsdf(RL_IN(Rng) rng, uint pixelIndex) {
  Bsdf b;
  float u = rngDraw(rng, RL_DIM_LIGHT_SELECT);
  b.alpha = 0.02f + 0.9f * u * u;
  float v = rngDraw(rng, RL_DIM_LIGHT_ALIAS);
  b.diffuse = vec3(0.8f * v, 0.5f, 0.7f - 0.6f * v);
  b.f0 = vec3(0.04f + 0.8f * v * v, 0.04f + 0.5f * v, 0.04f);
  b.f90 = 1.0f;
  b.eta = 1.5f;
  b.transmission = vec3(0.0f, 0.0f, 0.0f);
  b.lobes = RL_LOBE_DIFFUSE | RL_LOBE_SPECULAR;
  if ((pixelIndex & 3u) == 0u) {
    b.lobes = RL_LOBE_SPECULAR | RL_LOBE_TRANSMISSION;
    b.f0 = vec3(0.04f, 0.04f, 0.04f);
    b.diffuse = vec3(0.0f, 0.0f, 0.0f);
    b.transmission = vec3(0.9f, 0.95f, 0.9f);
  }
  return b;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  Bsdf bsdf = parityBsdf(rng, pixelIndex);
  vec2 u;
  u.x = rngDraw(rng, RL_DIM_LIGHT_U);
  u.y = rngDraw(rng, RL_DIM_LIGHT_V);
  vec3 normal = frameToWorld(vec3(0.0f, 0.6f, 0.8f), warpCosineHemisphere(u));
  u.x = rngDraw(rng, RL_DIM_DONOR_U);
  u.y = rngDraw(rng, RL_DIM_DONOR_V);
  vec3 wo = frameToWorld(normal, warpCosineHemisphere(u));

  RisResult result;
  result.picked = RL_INVALID;
  result.lobes = 0u;
  result.wSum = 0.0f;
  result.f = vec3(0.0f, 0.0f, 0.0f);
  result.wi = normal;
  float count = float(gParams.candidates);
  for (uint k = 0u; k < gParams.candidates; k = k + 1u) {
    rng.vertex = RL_VERTEX_CANDIDATES + k;
    float uLobe = rngDraw(rng, RL_DIM_BSDF_LOBE);
    u.x = rngDraw(rng, RL_DIM_BSDF_U);
    u.y = rngDraw(rng, RL_DIM_BSDF_V);
    BsdfSample draw = bsdfSample(bsdf, normal, normal, wo, uLobe, u);
    result.lobes = rngHash(result.lobes ^ draw.lobe);
    if (draw.lobe == 0u) continue;
    vec3 f = bsdfEval(bsdf, normal, normal, wo, draw.wi) * parityRadiance(draw.wi);
    float pHat = rlLuminance(f);
    float uAccept = rngDraw(rng, RL_DIM_RIS_LIGHT);
    if (risAccept(result.wSum, pHat / (draw.pdfSolidAngle * count), uAccept)) {
      result.picked = k;
      result.f = f;
      result.wi = draw.wi;
    }
  }
  result.W = risContributionWeight(result.wSum, rlLuminance(result.f));
  gBuffers.results.data[pixelIndex] = result;
}
