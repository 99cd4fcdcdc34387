// Gathers a pixel's path for its reservoir while the path is traced. The path is the one of `path`.
// Vertices: x1 in the pixel, x2, where other pixels reconnect, x3 beyond x2.
//
// - Direct light at x1: light samples, and the light that the BSDF sample hit.
// - Indirect light: x2 and its radiance to x1, by a light sample at x2 and by the path's suffix.
// - Light in view: emission and environment that the camera sees directly.
// - Unresampled light, which no other pixel could reuse: all light if x1 cannot be reused (mirror,
//   glass, roughness below the limit), light through a delta lobe at x2, and light of an x2 between
//   two bodies. Which part of the integrand that is depends on x2 alone, so that the split is the
//   same for every pixel.
#define RL_WALK_STATE PathRecord

RL_FN LightSample pathNoLight() {
  LightSample s;
  s.point = vec3(0.0f, 0.0f, 0.0f);
  s.kind = RL_LIGHT_POINT;
  s.normal = vec3(0.0f, 0.0f, 0.0f);
  s.pdf = 0.0f;
  s.radiance = vec3(0.0f, 0.0f, 0.0f);
  s.posError = 0.0f;
  s.cone = vec2(0.0f, 0.0f);
  s.isTwoSided = 0u;
  s.record = RL_INVALID;
  s.id = surfaceIdNone();
  return s;
}

// Density of the light samples of one pixel plus that of its BSDF sample (pdfSolidAngle towards the
// light), in the measure of the light sample (area, solid angle of the environment, discrete).
RL_FN float pathDirectDensity(RL_IN(LightSample) light, RL_IN(LightConnection) c,
                              float pdfSolidAngle) {
  float density = float(gParams.path.lightCandidates) * light.pdf;
  if (!c.isDelta) density += pdfSolidAngle * c.geometry;
  return density;
}

RL_FN PathRecord pathRecordEmpty(uint film) {
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  PathRecord p;
  p.unresampledRadiance = zero;
  p.inView = zero;
  p.film = film;
  p.isReusable = 0u;
  p.x1PosW = zero;
  p.x1NGeoW = zero;
  p.x1PosError = 0.0f;
  p.unshadowedContribution = zero;
  p.mediumTransmittance = vec3(1.0f, 1.0f, 1.0f);
  p.suffixThroughput = vec3(1.0f, 1.0f, 1.0f);
  p.fX1 = zero;
  p.pdfX1 = 0.0f;
  p.alphaTransmittanceX1 = 1.0f;
  p.light = pathNoLight();
  p.lightSum = 0.0f;
  p.lightF = zero;
  p.found = pathNoLight();
  p.bsdfHitIntegrand = zero;
  p.bsdfHitWeight = 0.0f;
  p.bsdfHitCoverage = 1.0f;
  p.isX2Apart = 0u;
  p.hasX2 = 0u;
  p.x2 = pathOfLight(pathNoLight(), film);
  p.surfaceX2 = surfaceNone();
  p.lightAtX2 = zero;
  p.lightDirX2 = zero;
  p.lightPdfX2 = 0.0f;
  p.isSuffix = 0u;
  p.pdfX2 = 0.0f;
  p.weightX2 = zero;
  p.dirX2 = zero;
  p.emittedAtX3 = zero;
  p.pdfLightAtX3 = 0.0f;
  p.suffixRadiance = zero;
  p.end.spread = 0.0f;
  p.end.group = RL_INVALID;
  return p;
}

RL_FN void pathReachesX2(RL_INOUT(PathRecord) p, RL_IN(Surface) s) {
  p.x2.id = s.id;
  p.x2.kind = RL_PATH_LAMBERT | (s.isFront != 0u ? 0u : RL_PATH_BACK);
  p.x2.geometry = shiftGeometryTerm(s.posW, s.nGeoW, p.x1PosW);
  p.surfaceX2 = s;
  p.hasX2 = 1u;
}

// Adds light that neither a light sample of x1 nor one of x2 carries: beyond x3, or not reusable.
RL_FN void pathAddLight(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(vec3) contribution) {
  if (p.isSuffix != 0u) {
    p.suffixRadiance += p.suffixThroughput * contribution;
  } else {
    p.unresampledRadiance += walk.throughput * contribution;
  }
}

// Position of the walk on a reusable path: at a vertex, or beyond it, where the shadow ray of that
// vertex is traced. x3 counts only if the path's suffix goes on beyond x2.
RL_FN bool pathIsAtX1(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.isReusable != 0u && walk.bounces == 0u;
}
RL_FN bool pathHasLeftX1(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.isReusable != 0u && walk.bounces == 1u;
}
RL_FN bool pathIsAtX2(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return pathHasLeftX1(p, walk) && p.isX2Apart == 0u;
}
RL_FN bool pathIsAtX3(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.isSuffix != 0u && walk.bounces == 2u;
}
RL_FN bool pathHasLeftX2(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.hasX2 != 0u && walk.bounces == 2u;
}

RL_FN void onMiss(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(vec3) radiance, float pdfLight) {
  if (pathIsAtX2(p, walk)) {
    p.alphaTransmittanceX1 = walk.passed;
    p.found.kind = RL_LIGHT_ENVIRONMENT;
    p.found.point = walk.ray.dir;
    p.found.pdf = pdfLight;
    p.found.radiance = radiance;
    p.bsdfHitIntegrand = p.fX1 * radiance;
    p.bsdfHitWeight = rlLuminance(p.bsdfHitIntegrand) *
                      rlSafeDivide(1.0f, float(gParams.path.lightCandidates) * pdfLight + p.pdfX1);
  } else if (pathIsAtX3(p, walk)) {
    p.emittedAtX3 = radiance;
    p.pdfLightAtX3 = pathPackedPdf(pdfLight);
  } else if (walk.bounces == 0u) {
    p.inView = walk.throughput * radiance;
  } else {
    pathAddLight(p, walk,
                 radiance * (pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f));
  }
}

RL_FN void onEmission(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(Hit) hit,
                      float pdfLight) {
  if (pathIsAtX2(p, walk)) {
    p.alphaTransmittanceX1 = walk.passed;
    float cosLight = abs(dot(s.nGeoW, walk.ray.dir));
    float geometry = cosLight / (hit.t * hit.t);
    p.found.kind = RL_LIGHT_TRIANGLE;
    p.found.id = s.id;
    p.found.point = s.posW;
    p.found.normal = s.nGeoW;
    p.found.posError = s.posError;
    p.found.pdf = pdfLight * geometry;
    p.found.radiance = s.emission;
    if (RL_HAS(RL_FEATURE_ALPHA)) {
      p.bsdfHitCoverage = surfaceAlpha(hit);
      p.found.radiance *= p.bsdfHitCoverage;
    }
    // Unlit surfaces are not in the light table and shine to both sides.
    p.found.isTwoSided = RL_MATERIAL_DOUBLE_SIDED;
    if (s.light != RL_INVALID)
      p.found.isTwoSided = recordLight(s.light).flags & RL_MATERIAL_DOUBLE_SIDED;
    p.bsdfHitIntegrand = p.fX1 * s.emission * geometry;
    p.bsdfHitWeight =
        rlLuminance(p.bsdfHitIntegrand) *
        rlSafeDivide(1.0f, (float(gParams.path.lightCandidates) * pdfLight + p.pdfX1) * geometry);
  } else if (pathIsAtX3(p, walk)) {
    p.emittedAtX3 = s.emission * p.mediumTransmittance;
    p.pdfLightAtX3 = pathPackedPdf(pdfLight);
  } else if (walk.bounces == 0u) {
    p.inView = walk.throughput * s.emission;
  } else {
    pathAddLight(p, walk,
                 s.emission * (pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f));
  }
}

RL_FN void onMedium(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {
  p.mediumTransmittance = transmittance;
  p.suffixThroughput *= transmittance;
}

// At x2, the radiance leaves in every direction, as from a Lambert surface.
RL_FN void onEnd(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(vec3) radiance) {
  bool isApart = RL_HAS(RL_FEATURE_VOLUME) && s.contrast > 0.0f;
  if (!pathIsAtX2(p, walk) || isApart) {
    pathAddLight(p, walk, radiance);
    return;
  }
  p.alphaTransmittanceX1 = walk.passed;
  pathReachesX2(p, s);
  p.surfaceX2.bsdf = bsdfNone();
  p.surfaceX2.bsdf.lobes = RL_LOBE_DIFFUSE;
  p.isSuffix = 1u;
  p.pdfX2 = 1.0f;
  p.weightX2 = vec3(1.0f, 1.0f, 1.0f);
  p.suffixRadiance = radiance;
}

RL_FN uint onVertex(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  if (walk.bounces == 0u) {  // x1, reusable or not
    p.x1PosW = s.posW;
    p.x1NGeoW = s.nGeoW;
    p.x1PosError = s.posError;
    bool isReusable = bsdfIsReusable(s.bsdf, gParams.path.minAlpha) &&
                      (gFrame.cameraAbsorbs & RL_CAMERA_ABSORBS_NOW) == 0u;
    p.isReusable = isReusable ? 1u : 0u;
    if (p.isReusable == 0u) RL_HEALTH(RL_HEALTH_UNREUSABLE_PIXELS);
  }
  if (pathHasLeftX1(p, walk)) {
    p.alphaTransmittanceX1 = walk.passed;
    if (RL_HAS(RL_FEATURE_VOLUME) && s.contrast > 0.0f) p.isX2Apart = 1u;
  }
  return pathIsAtX1(p, walk) ? gParams.path.lightCandidates : 1u;
}

RL_FN bool onLightSample(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Rng) rng, RL_IN(Surface) s,
                         RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  if (pathIsAtX1(p, walk)) {
    vec3 integrand = f * c.emitted * c.geometry;
    real w = rlLuminance(integrand) * rlSafeDivide(1.0f, pathDirectDensity(light, c, pdf));
    if (!risAccept(p.lightSum, w, rngDraw(rng, RL_DIM_RIS_LIGHT))) return false;
    p.light = light;
    p.lightF = integrand;
    return true;
  }
  if (rlIsBlack(f)) return false;
  vec3 arriving = c.emitted * (c.geometry / light.pdf);
  if (RL_HAS(RL_FEATURE_VOLUME)) arriving *= exp(-surfaceSigma(s, walk.sigma, c.dirW) * c.distance);
  if (pathIsAtX2(p, walk)) {
    p.lightAtX2 = arriving;
    p.lightDirX2 = pathPackedWi(c.dirW);
    p.lightPdfX2 = c.isDelta ? 0.0f : pathPackedPdf(c.pdfSolidAngle);
    return true;
  }
  float weight = c.isDelta ? 1.0f : lightMisWeight(c.pdfSolidAngle, pdf);
  p.unshadowedContribution =
      (p.isSuffix != 0u ? p.suffixThroughput : walk.throughput) * f * arriving * weight;
  return true;
}

RL_FN void onShadowRay(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, float transmittance) {
  if (pathHasLeftX1(p, walk)) {
    p.lightF *= transmittance;
    p.lightSum *= transmittance;
  } else if (pathHasLeftX2(p, walk)) {
    p.lightAtX2 *= transmittance;
  } else if (p.isSuffix != 0u) {
    p.suffixRadiance += p.unshadowedContribution * transmittance;
  } else {
    p.unresampledRadiance += p.unshadowedContribution * transmittance;
  }
}

RL_FN void onBsdfSample(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Surface) s,
                        RL_IN(BsdfSample) draw) {
  if (pathIsAtX1(p, walk)) {
    p.fX1 = draw.weight * draw.pdfSolidAngle;
    p.pdfX1 = draw.pdfSolidAngle;
  } else if (pathIsAtX2(p, walk)) {
    pathReachesX2(p, s);
    if (walk.isAlive != 0u && (draw.lobe & RL_LOBE_ANY_DELTA) == 0u) {
      p.isSuffix = 1u;
      p.pdfX2 = draw.pdfSolidAngle;
      p.weightX2 = draw.weight;
      p.dirX2 = pathPackedWi(draw.wi);
    }
  } else if (p.isSuffix != 0u) {
    p.suffixThroughput *= draw.weight;
  }
}

RL_FN void onRoulette(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, float factor) {
  p.suffixThroughput *= factor;
}

#include "core/transport/walk.glsl"
