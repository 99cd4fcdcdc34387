// path: the yardstick. One path per pixel and frame; at each vertex one light sample and one BSDF
// sample, combined by the power heuristic (Veach 1997, chapter 9). Unbiased.
//
// Each round of the loop traces at most two rays through one call site: the shadow ray of the last
// vertex's light sample, then the path's own next ray.

RL_FN bool pathWants(uint bounces) {
  uint component = bounces >= 2u ? RL_COMPONENT_INDIRECT : RL_COMPONENT_DIRECT;
  return (gFrame.components & component) != 0u;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  Ray ray = cameraRay(gFrame.camera, cameraFilmSample(pixel), resolution);

  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  vec3 throughput = vec3(1.0f, 1.0f, 1.0f);
  vec3 sigma = vec3(0.0f, 0.0f, 0.0f);  // absorption of the medium that the ray travels in
  float pdfBsdf = 0.0f;  // 0: camera ray or delta lobe, which light sampling cannot make
  vec3 lightContribution = vec3(0.0f, 0.0f, 0.0f);
  bool hasShadowRay = false;
  bool alive = true;
  Ray shadowRay = ray;

  for (uint bounces = 0u;; bounces = bounces + 1u) {
    Hit hit;
    hit.instance = RL_INVALID;
    for (uint which = 0u; which < 2u; which = which + 1u) {
      bool isShadow = which == 0u;
      if (isShadow ? !hasShadowRay : !alive) continue;
      Ray traced = ray;
      if (isShadow) traced = shadowRay;
      uint mode = isShadow ? RL_RAY_SHADOW : RL_RAY_PATH;
      float transmittance = traceRay(traced, mode, rng.key.x + bounces * 0x632be59bu, hit);
      if (isShadow) radiance += lightContribution * transmittance;
    }
    if (!alive) break;
    hasShadowRay = false;

    if (hit.instance == RL_INVALID) {
      if (environmentExists() && pathWants(bounces)) {
        float weight = 1.0f;
        if (pdfBsdf > 0.0f) weight = lightMisWeight(pdfBsdf, lightPdfOfEnvironment(ray.dir));
        radiance += throughput * environmentRadiance(ray.dir) * weight;
      }
      break;
    }
    Surface s = surfaceLoad(hit, ray.dir);
    if (RL_HAS(RL_FEATURE_VOLUME)) throughput *= exp(-sigma * hit.t);
    if (!rlIsBlack(s.emission) && pathWants(bounces)) {
      float weight = 1.0f;
      if (pdfBsdf > 0.0f && s.light != RL_INVALID) {
        weight = lightMisWeight(pdfBsdf, lightPdfOfHit(s.light, s.nGeoW, ray.dir, hit.t));
      }
      radiance += throughput * s.emission * weight;
    }
    if (bounces >= gFrame.maxBounces || bsdfIsBlack(s.bsdf)) break;
    rng.vertex = bounces + 1u;

    if (lightExists() && pathWants(bounces + 1u)) {
      LightSample light = lightDraw(rng);
      LightConnection c = lightConnect(light, s.posW);
      vec3 f = bsdfEval(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW);
      if (light.pdf > 0.0f && !rlIsBlack(f) && !rlIsBlack(c.emitted)) {
        float weight = 1.0f;
        if (!c.isDelta) {
          weight =
              lightMisWeight(c.pdfSolidAngle, bsdfPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW));
        }
        lightContribution = throughput * f * c.emitted * (c.geometry * weight / light.pdf);
        if (RL_HAS(RL_FEATURE_VOLUME))
          lightContribution *= exp(-surfaceSigma(s, sigma, c.dirW) * c.distance);
        shadowRay = lightShadowRay(light, c, s.posW, s.nGeoW, s.posError);
        hasShadowRay = true;
      }
    }

    float uLobe = rngDraw(rng, RL_DIM_BSDF_LOBE);
    vec2 u;
    u.x = rngDraw(rng, RL_DIM_BSDF_U);
    u.y = rngDraw(rng, RL_DIM_BSDF_V);
    BsdfDraw draw = bsdfDraw(s.bsdf, s.nGeoW, s.nShadeW, s.wo, uLobe, u);
    alive = draw.lobe != 0u && !rlIsBlack(draw.weight);
    throughput *= draw.weight;
    if (alive && bounces + 1u >= gFrame.rouletteStart) {
      float survival = min(rlMax3(throughput), 0.95f);
      if (rngDraw(rng, RL_DIM_ROULETTE) < survival) {
        throughput *= 1.0f / survival;
      } else {
        alive = false;
      }
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
