// restir_gi, initial pass: traces the pixel's path as `path` does and sorts what it finds.
//   x1 cannot be reused (mirror, glass, roughness below the limit): the path is shaded as it is
//   direct light    light samples and the BSDF sample of x1 -> the light reservoir
//   indirect light  x2 and what it sends to x1 -> the path reservoir
//   a delta lobe drawn at x2: that part of the integrand is shaded as it is (which part it is
//   depends on x2 alone, so the split is the same for every pixel)
#include "core/resampling/ris.glsl"
#include "integrators/restir_gi/store.glsl"
#include "core/caches/cache.glsl"
#include "core/caches/pixel.glsl"

RL_FN bool giWants(uint bounces) {
  uint component = bounces >= 2u ? RL_COMPONENT_INDIRECT : RL_COMPONENT_DIRECT;
  return (gFrame.components & component) != 0u;
}

RL_FN ReservoirState giEmptyState() {
  ReservoirState state;
  state.F = vec3(0.0f, 0.0f, 0.0f);
  state.W = 0.0f;
  state.residual = vec3(0.0f, 0.0f, 0.0f);
  state.confidence = 1.0f;
  return state;
}

RL_FN LightSample giNoLight() {
  LightSample s;
  s.point = vec3(0.0f, 0.0f, 0.0f);
  s.kind = RL_LIGHT_POINT;
  s.normal = vec3(0.0f, 0.0f, 0.0f);
  s.pdf = 0.0f;
  s.radiance = vec3(0.0f, 0.0f, 0.0f);
  s.posError = 0.0f;
  s.cone = vec2(0.0f, 0.0f);
  s.isTwoSided = 0u;
  return s;
}

RL_FN PathSuffix giNoSuffix() {
  PathSuffix s;
  s.nShadeW = vec3(0.0f, 0.0f, 1.0f);
  s.wi = vec3(0.0f, 0.0f, 1.0f);
  s.emitted = vec3(0.0f, 0.0f, 0.0f);
  s.pdfLight = 0.0f;
  s.bsdf.diffuse = vec3(0.0f, 0.0f, 0.0f);
  s.bsdf.lobes = 0u;
  s.bsdf.f0 = vec3(0.0f, 0.0f, 0.0f);
  s.bsdf.f90 = 0.0f;
  s.bsdf.transmission = vec3(0.0f, 0.0f, 0.0f);
  s.bsdf.alpha = 1.0f;
  s.bsdf.eta = 1.0f;
  return s;
}

// Can this surface's samples be exchanged? Decided by the surface alone.
RL_FN bool giIsReusable(RL_IN(Bsdf) b) {
  if (bsdfIsBlack(b)) return false;
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return true;
  if ((b.lobes & (RL_LOBE_ANY_DELTA | RL_LOBE_ANY_TRANSMISSION)) != 0u) return false;
  return (b.lobes & RL_LOBE_SPECULAR) == 0u || b.alpha >= gParams.minAlpha;
}

// Density of the light samples of one pixel plus that of its BSDF sample, in the measure of the
// light sample (area, solid angle of the environment, discrete). dirW points to the light.
RL_FN float giDirectDensity(RL_IN(LightSample) light, RL_IN(LightConnection) c, RL_IN(Anchor) a) {
  float density = float(gParams.lightCandidates) * light.pdf;
  if (!c.isDelta) density += bsdfPdf(a.bsdf, a.nGeoW, a.nShadeW, a.wo, c.dirW) * c.geometry;
  return density;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
  Ray ray = cameraRay(gFrame.camera, cameraFilmSample(pixel), resolution);

  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  vec3 ownLight = zero;
  Anchor anchor;
  anchor.posW = zero;
  anchor.posError = 0.0f;
  anchor.nGeoW = vec3(0.0f, 0.0f, 1.0f);
  anchor.nShadeW = anchor.nGeoW;
  anchor.wo = anchor.nGeoW;
  anchor.isReusable = 0u;
  anchor.bsdf = giNoSuffix().bsdf;
  bool reusable = false;

  LightReservoir direct;
  direct.light = giNoLight();
  direct.state = giEmptyState();
  real directSum = 0.0f;       // resampling weights of the light samples
  vec3 directF = zero;         // integrand of their selected one
  vec3 foundF = zero;          // integrand of the BSDF sample that met a light
  real foundWeight = 0.0f;     // its resampling weight
  float foundCoverage = 1.0f;  // of the light that it met: what chance let it meet it
  LightSample found = giNoLight();

  PathReservoir path;
  path.vertex.posW = zero;
  path.vertex.posError = 0.0f;
  path.vertex.nGeoW = vec3(0.0f, 0.0f, 1.0f);
  path.vertex.kind = RL_PATH_LAMBERT;
  path.vertex.radiance = zero;
  path.suffix = giNoSuffix();
  path.state = giEmptyState();

  // The path is cut at x2: `throughput` is that of x1 up to there, `suffixThroughput` that from x3
  // on.
  vec3 throughput = vec3(1.0f, 1.0f, 1.0f);  // up to the current vertex, as in `path`
  vec3 suffixThroughput = vec3(1.0f, 1.0f, 1.0f);
  bool hasX2 = false;  // a connectable x2 was found
  vec3 fX1 = zero;     // f |cos| at x1 towards x2
  float pdfX1 = 0.0f;
  vec3 lightAtX2 = zero;  // light sample at x2 over its density, without BSDF and MIS weight at x2
  vec3 lightDirX2 = zero;
  float lightPdfX2 = 0.0f;
  float pdfX2 = 0.0f;    // of the continuation at x2
  vec3 weightX2 = zero;  // f |cos| / pdf of it
  vec3 dirX2 = zero;
  vec3 emittedAtX3 = zero;
  float pdfLightAtX3 = 0.0f;
  vec3 rest = zero;  // light beyond x3
  vec3 woX2 = vec3(0.0f, 0.0f, 1.0f);

  vec3 sigma = zero;
  float pdfBsdf = 0.0f;
  vec3 lightContribution = zero;
  bool hasShadowRay = false;
  bool alive = true;
  bool isSuffix = false;     // beyond x2 on the connectable part
  bool passedAlpha = false;  // the ray from x1 may have passed something partly transparent
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
      if (isShadow) {
        if (reusable && bounces == 1u) {
          directF *= transmittance;
          directSum *= transmittance;
        } else if (hasX2 && bounces == 2u) {
          lightAtX2 *= transmittance;
        } else if (isSuffix) {
          rest += lightContribution * transmittance;
        } else {
          ownLight += lightContribution * transmittance;
        }
      } else if (RL_HAS(RL_FEATURE_ALPHA) && bounces == 1u) {
        passedAlpha = transmittance < 1.0f;
      }
    }
    if (!alive) break;
    hasShadowRay = false;

    if (hit.instance == RL_INVALID) {
      if (environmentExists() && giWants(bounces)) {
        vec3 radiance = environmentRadiance(ray.dir);
        float pdfLight = pdfBsdf > 0.0f ? lightPdfOfEnvironment(ray.dir) : 0.0f;
        if (reusable && bounces == 1u) {
          found.kind = RL_LIGHT_ENVIRONMENT;
          found.point = ray.dir;
          found.pdf = pdfLight;
          found.radiance = radiance;
          foundF = fX1 * radiance;
          foundWeight = rlLuminance(foundF) *
                        rlSafeDivide(1.0f, float(gParams.lightCandidates) * pdfLight + pdfX1);
        } else if (isSuffix && bounces == 2u) {
          emittedAtX3 = radiance;
          pdfLightAtX3 = pdfLight;
        } else {
          float weight = pdfBsdf > 0.0f ? lightMisWeight(pdfBsdf, pdfLight) : 1.0f;
          vec3 contribution = radiance * weight;
          if (isSuffix) {
            rest += suffixThroughput * contribution;
          } else {
            ownLight += throughput * contribution;
          }
        }
      }
      break;
    }
    Surface s = surfaceLoad(hit, ray.dir);
    vec3 absorbed = vec3(1.0f, 1.0f, 1.0f);
    if (RL_HAS(RL_FEATURE_VOLUME)) {
      absorbed = exp(-sigma * hit.t);
      throughput *= absorbed;
      suffixThroughput *= absorbed;
    }
    if (!rlIsBlack(s.emission) && giWants(bounces)) {
      bool competes = pdfBsdf > 0.0f && s.light != RL_INVALID;
      float pdfLight = competes ? lightPdfOfHit(s.light, s.nGeoW, ray.dir, hit.t) : 0.0f;
      if (reusable && bounces == 1u) {
        float cosLight = abs(dot(s.nGeoW, ray.dir));
        float geometry = cosLight / (hit.t * hit.t);
        found.kind = RL_LIGHT_TRIANGLE;
        found.point = s.posW;
        found.normal = s.nGeoW;
        found.posError = s.posError;
        found.pdf = pdfLight * geometry;
        found.radiance = s.emission;
        if (RL_HAS(RL_FEATURE_ALPHA)) {
          foundCoverage = surfaceAlpha(hit);
          found.radiance *= foundCoverage;
        }
        // Unlit surfaces are not in the light table and shine to both sides.
        found.isTwoSided = RL_MATERIAL_DOUBLE_SIDED;
        if (s.light != RL_INVALID)
          found.isTwoSided = recordLight(s.light).flags & RL_MATERIAL_DOUBLE_SIDED;
        foundF = fX1 * s.emission * geometry;
        foundWeight =
            rlLuminance(foundF) *
            rlSafeDivide(1.0f, (float(gParams.lightCandidates) * pdfLight + pdfX1) * geometry);
      } else if (isSuffix && bounces == 2u) {
        emittedAtX3 = s.emission * absorbed;
        pdfLightAtX3 = pdfLight;
      } else {
        float weight = competes ? lightMisWeight(pdfBsdf, pdfLight) : 1.0f;
        vec3 contribution = s.emission * weight;
        if (isSuffix) {
          rest += suffixThroughput * contribution;
        } else {
          ownLight += throughput * contribution;
        }
      }
    }
    if (bounces >= gFrame.maxBounces || bsdfIsBlack(s.bsdf)) break;
    rng.vertex = bounces + 1u;
    if (bounces == 0u) {
      anchor.posW = s.posW;
      anchor.posError = s.posError;
      anchor.nGeoW = s.nGeoW;
      anchor.nShadeW = s.nShadeW;
      anchor.bsdf = s.bsdf;
      anchor.wo = cameraDirectionFrom(gFrame.camera, s.posW);
      s.wo = anchor.wo;
      reusable = giIsReusable(s.bsdf);
      anchor.isReusable = reusable ? 1u : 0u;
      if (!reusable) RL_HEALTH(RL_HEALTH_UNREUSABLE_PIXELS);
    }
    bool atX1 = reusable && bounces == 0u;
    bool atX2 = reusable && bounces == 1u;

    if (lightExists() && giWants(bounces + 1u)) {
      uint candidates = atX1 ? gParams.lightCandidates : 1u;
      for (uint i = 0u; i < candidates; i = i + 1u) {
        Rng r = rng;
        if (i > 0u) r.vertex = RL_VERTEX_CANDIDATES + i;
        LightSample light = lightDraw(r);
        LightConnection c = lightConnect(light, s.posW);
        if (!(light.pdf > 0.0f) || rlIsBlack(c.emitted)) continue;
        vec3 f = bsdfEval(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW);
        if (atX1) {
          vec3 integrand = f * c.emitted * c.geometry;
          real w = rlLuminance(integrand) * rlSafeDivide(1.0f, giDirectDensity(light, c, anchor));
          if (risAccept(directSum, w, rngDraw(r, RL_DIM_RIS_LIGHT))) {
            direct.light = light;
            directF = integrand;
            shadowRay = lightShadowRay(light, c, s.posW, s.nGeoW, s.posError);
            hasShadowRay = true;
          }
          continue;
        }
        if (rlIsBlack(f)) continue;
        vec3 arriving = c.emitted * (c.geometry / light.pdf);
        if (RL_HAS(RL_FEATURE_VOLUME))
          arriving *= exp(-surfaceSigma(s, sigma, c.dirW) * c.distance);
        shadowRay = lightShadowRay(light, c, s.posW, s.nGeoW, s.posError);
        hasShadowRay = true;
        if (atX2) {
          lightAtX2 = arriving;
          lightDirX2 = c.dirW;
          lightPdfX2 = c.isDelta ? 0.0f : c.pdfSolidAngle;
          continue;
        }
        float weight = 1.0f;
        if (!c.isDelta) {
          weight =
              lightMisWeight(c.pdfSolidAngle, bsdfPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW));
        }
        lightContribution = (isSuffix ? suffixThroughput : throughput) * f * arriving * weight;
      }
    }

    float uLobe = rngDraw(rng, RL_DIM_BSDF_LOBE);
    vec2 u;
    u.x = rngDraw(rng, RL_DIM_BSDF_U);
    u.y = rngDraw(rng, RL_DIM_BSDF_V);
    BsdfDraw draw = bsdfDraw(s.bsdf, s.nGeoW, s.nShadeW, s.wo, uLobe, u);
    bool isDelta = (draw.lobe & RL_LOBE_ANY_DELTA) != 0u;
    alive = draw.lobe != 0u && !rlIsBlack(draw.weight);
    if (atX1) {
      fX1 = draw.weight * draw.pdfSolidAngle;
      pdfX1 = draw.pdfSolidAngle;
    }
    if (atX2) {
      path.vertex.posW = s.posW;
      path.vertex.posError = s.posError;
      path.vertex.nGeoW = s.nGeoW;
      path.suffix.nShadeW = s.nShadeW;
      path.suffix.bsdf = s.bsdf;
      woX2 = s.wo;
      hasX2 = true;
      if (alive && !isDelta) {
        isSuffix = true;
        pdfX2 = draw.pdfSolidAngle;
        weightX2 = draw.weight;
        dirX2 = draw.wi;
      }
    }
    throughput *= draw.weight;
    if (isSuffix && !atX2) suffixThroughput *= draw.weight;
    if (alive && bounces + 1u >= gFrame.rouletteStart) {
      float survival = min(rlMax3(throughput), 0.95f);
      if (rngDraw(rng, RL_DIM_ROULETTE) < survival) {
        throughput *= 1.0f / survival;
        suffixThroughput *= 1.0f / survival;
      } else {
        alive = false;
      }
    }
    pdfBsdf = isDelta ? 0.0f : draw.pdfSolidAngle;
    if (RL_HAS(RL_FEATURE_VOLUME)) sigma = surfaceSigma(s, sigma, draw.wi);
    ray.origin = surfaceOffset(s.posW, s.nGeoW, s.posError, draw.wi);
    ray.dir = draw.wi;
  }

  // Path rays pass a partly transparent surface by chance, connections are dimmed by it. What the
  // ray from x1 has found, it has found with a probability of T, the transmittance up to there: its
  // integrand gets T, as every other pixel evaluates it, and its weight 1 / T. The coverage of a
  // light that is itself partly transparent is such a factor, too; that of x2 is the same for every
  // pixel and stays out.
  float throughAlpha = 1.0f;
  if (RL_HAS(RL_FEATURE_ALPHA) && reusable && passedAlpha && (hasX2 || foundWeight > 0.0f)) {
    Ray segment;
    if (hasX2) {
      vec3 d = path.vertex.posW - anchor.posW;
      segment.origin = surfaceOffset(anchor.posW, anchor.nGeoW, anchor.posError, d);
      segment.tMin = 0.0f;
      segment.dir = surfaceOffset(path.vertex.posW, path.vertex.nGeoW, path.vertex.posError, -d) -
                    segment.origin;
      segment.tMax = 1.0f;
    } else {
      segment = lightShadowRay(found, lightConnect(found, anchor.posW), anchor.posW, anchor.nGeoW,
                               anchor.posError);
    }
    Hit hit;
    float t = traceRay(segment, RL_RAY_SHADOW, 0u, hit);
    // 0: the two rays disagree by rounding; the path ray is believed, as it is among opaque
    // surfaces.
    if (t > 0.0f) throughAlpha = t;
  }
  if (RL_HAS(RL_FEATURE_ALPHA))
    foundF *= throughAlpha * foundCoverage;  // foundWeight = pHat W stays

  if (reusable) {
    // Direct light: one reservoir of two techniques whose balance weights are inside the densities.
    real directW = risContributionWeight(directSum, rlLuminance(directF));
    vec3 estimate =
        directF * directW + foundF * risContributionWeight(foundWeight, rlLuminance(foundF));
    real wSum = 0.0f;
    direct.state.F = directF;
    bool keep =
        risAccept(wSum, directSum, 0.0f);  // the first candidate is kept unless its weight is zero
    if (!keep) direct.state.F = zero;
    rng.vertex = RL_VERTEX_PIXEL;
    if (risAccept(wSum, foundWeight, rngDraw(rng, RL_DIM_RIS_DIRECT))) {
      direct.light = found;
      direct.state.F = foundF;
    }
    direct.state.W = risContributionWeight(wSum, rlLuminance(direct.state.F));
    direct.state.residual = estimate - direct.state.F * direct.state.W;
  }
  if (hasX2) {
    vec3 fLight = zero;        // at x2, light sample
    vec3 continuation = zero;  // at x2, over pdfX2
    Bsdf bsdfX2 = path.suffix.bsdf;
    vec3 nGeoX2 = path.vertex.nGeoW;
    vec3 nShadeX2 = path.suffix.nShadeW;
    if (!rlIsBlack(lightAtX2)) {
      float weight = 1.0f;
      if (lightPdfX2 > 0.0f) {
        weight = lightMisWeight(lightPdfX2, bsdfPdf(bsdfX2, nGeoX2, nShadeX2, woX2, lightDirX2));
      }
      fLight = bsdfEval(bsdfX2, nGeoX2, nShadeX2, woX2, lightDirX2) * lightAtX2 * weight;
    }
    if (isSuffix) {
      float weight = pdfLightAtX3 > 0.0f ? lightMisWeight(pdfX2, pdfLightAtX3) : 1.0f;
      continuation = weightX2 * (rest + emittedAtX3 * weight);
    }
    float inverseX1 = rlSafeDivide(1.0f, pdfX1);
    if (!RL_HAS(RL_FEATURE_GLOSSY) || bsdfX2.lobes == RL_LOBE_DIFFUSE) {
      path.vertex.radiance = fLight + continuation;
      path.state.F = fX1 * path.vertex.radiance;
      path.state.W = rlLuminance(path.state.F) > 0.0f ? inverseX1 : 0.0f;
    } else {
      // Two disjoint kinds of paths: one is selected, the estimate keeps the colours of both.
      vec3 fOfLight = fX1 * fLight;
      vec3 fOfContinuation = fX1 * continuation * pdfX2;
      real wSum = 0.0f;
      bool any = risAccept(wSum, rlLuminance(fOfLight) * inverseX1, 0.0f);
      path.vertex.kind = RL_PATH_LIGHT;
      path.vertex.radiance = lightAtX2;
      path.suffix.wi = lightDirX2;
      path.suffix.pdfLight = lightPdfX2;
      path.state.F = fOfLight;
      rng.vertex = RL_VERTEX_PIXEL;
      real wContinuation = rlLuminance(fOfContinuation) * inverseX1 * rlSafeDivide(1.0f, pdfX2);
      if (risAccept(wSum, wContinuation, rngDraw(rng, RL_DIM_RIS_SUFFIX)) || !any) {
        path.vertex.kind = RL_PATH_CONTINUATION;
        path.vertex.radiance = rest;
        path.suffix.wi = dirX2;
        path.suffix.emitted = emittedAtX3;
        path.suffix.pdfLight = pdfLightAtX3;
        path.state.F = fOfContinuation;
      }
      path.state.W = risContributionWeight(wSum, rlLuminance(path.state.F));
      vec3 estimate = fX1 * (fLight + continuation) * inverseX1;
      path.state.residual = estimate - path.state.F * path.state.W;
    }
    if (RL_HAS(RL_FEATURE_ALPHA)) {
      path.state.F *= throughAlpha;
      path.state.W /= throughAlpha;
    }
    if (!(path.state.W > 0.0f)) {
      path.state.W = 0.0f;
      path.state.F = zero;
      path.state.residual = zero;
    }
  }
  bool finite = rlIsFinite3(ownLight) &&
                rlIsFinite3(direct.state.F * direct.state.W + direct.state.residual) &&
                rlIsFinite3(path.state.F * path.state.W + path.state.residual);
  if (!finite) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    ownLight = zero;
    direct.state = giEmptyState();
    path.state = giEmptyState();
  }
  gBuffers.ownLight.data[slot] = ownLight;
  cacheWriteAnchor(slot, anchor);
  if (giWants(1u)) cacheWriteNow(slot, direct);
  if (giWants(2u)) cacheWriteNow(slot, path);
}
