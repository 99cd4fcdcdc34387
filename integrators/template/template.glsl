// template: the smallest integrator that is complete, made to be copied (CONTRIBUTING.md).
//
// Estimator: one path per pixel and frame. Every vertex takes one light sample and goes on in one
// direction drawn from its BSDF, which may meet a light, too. MIS weights: p^b / (p^b + q^b) of the
// two densities (Veach 1997, section 9.2.3; b is the parameter mis_exponent). Bias: none, the
// weights of the techniques that can make a path sum to one, and every path has one.

// Direct light is what has scattered once at most; the rest is indirect.
RL_FN bool templateWants(uint bounces) {
  uint component = bounces >= 2u ? RL_COMPONENT_INDIRECT : RL_COMPONENT_DIRECT;
  return (gFrame.components & component) != 0u;
}

// Of a technique with density p beside one with density q.
RL_FN float templateMisWeight(float p, float q) {
  return p > 0.0f ? 1.0f / (1.0f + pow(q / p, gParams.misExponent)) : 0.0f;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  Ray ray = cameraRay(gFrame.camera, cameraFilmSample(pixel), resolution);

  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  vec3 throughput = vec3(1.0f, 1.0f, 1.0f);
  vec3 sigma = vec3(0.0f, 0.0f, 0.0f);  // absorption of the medium that the ray travels in
  float pdfBsdf = 0.0f;                 // of the ray; 0 where no light sample competes with it

  for (uint bounces = 0u;; bounces = bounces + 1u) {
    // What the hash decides is which partly transparent surfaces the ray passes.
    uint raySeed = rng.key.x + bounces * 0x632be59bu;
    Hit hit;
    traceRay(ray, RL_RAY_PATH, raySeed, hit);
    if (hit.instance == RL_INVALID) {
      if (environmentExists() && templateWants(bounces)) {
        float weight = 1.0f;
        if (pdfBsdf > 0.0f) weight = templateMisWeight(pdfBsdf, lightPdfOfEnvironment(ray.dir));
        radiance += throughput * environmentRadiance(ray.dir) * weight;
      }
      break;
    }
    Surface s = surfaceLoad(hit, ray.dir);
    if (RL_HAS(RL_FEATURE_VOLUME)) throughput *= exp(-sigma * hit.t);
    if (!rlIsBlack(s.emission) && templateWants(bounces)) {
      float weight = 1.0f;
      if (pdfBsdf > 0.0f && s.light != RL_INVALID) {
        weight = templateMisWeight(pdfBsdf, lightPdfOfHit(s.light, s.nGeoW, ray.dir, hit.t));
      }
      radiance += throughput * s.emission * weight;
    }
    if (bounces >= gFrame.maxBounces || bsdfIsBlack(s.bsdf)) break;
    rng.vertex = bounces + 1u;  // draws of different vertices are independent

    if (lightExists() && templateWants(bounces + 1u)) {
      LightSample light = lightDraw(rng);
      LightConnection c = lightConnect(light, s.posW);
      vec3 f = bsdfEval(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW);
      if (light.pdf > 0.0f && !rlIsBlack(f) && !rlIsBlack(c.emitted)) {
        float weight = 1.0f;  // a point or a direction is met by no ray
        if (!c.isDelta) {
          float pdf = bsdfPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW);
          weight = templateMisWeight(c.pdfSolidAngle, pdf);
        }
        Ray shadowRay = lightShadowRay(light, c, s.posW, s.nGeoW, s.posError);
        vec3 arriving = c.emitted * (c.geometry * weight / light.pdf);
        if (RL_HAS(RL_FEATURE_VOLUME))
          arriving *= exp(-surfaceSigma(s, sigma, c.dirW) * c.distance);
        Hit unused;
        float transmittance = traceRay(shadowRay, RL_RAY_SHADOW, raySeed, unused);
        radiance += throughput * f * arriving * transmittance;
      }
    }

    float uLobe = rngDraw(rng, RL_DIM_BSDF_LOBE);
    vec2 u;
    u.x = rngDraw(rng, RL_DIM_BSDF_U);
    u.y = rngDraw(rng, RL_DIM_BSDF_V);
    BsdfDraw draw = bsdfDraw(s.bsdf, s.nGeoW, s.nShadeW, s.wo, uLobe, u);
    throughput *= draw.weight;
    if (draw.lobe == 0u || rlIsBlack(throughput)) break;
    if (bounces + 1u >= gFrame.rouletteStart) {
      float survival = min(rlMax3(throughput), 0.95f);
      if (!(rngDraw(rng, RL_DIM_ROULETTE) < survival)) break;
      throughput *= 1.0f / survival;
    }
    pdfBsdf = (draw.lobe & RL_LOBE_ANY_DELTA) != 0u ? 0.0f : draw.pdfSolidAngle;
    if (RL_HAS(RL_FEATURE_VOLUME)) sigma = surfaceSigma(s, sigma, draw.wi);
    ray.origin = surfaceOffset(s.posW, s.nGeoW, s.posError, draw.wi);
    ray.dir = draw.wi;
  }

  if (!rlIsFinite3(radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixelIndex] = radiance;
}
