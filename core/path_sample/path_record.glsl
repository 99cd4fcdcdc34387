// Gathers a pixel's path for its reservoir while the path is traced. The path is the one of `path`.
// Vertices: x1 in the pixel, x2, where other pixels reconnect, x3 beyond x2.
//
// - Direct light at x1: light samples, and the light that the BSDF sample hit.
// - Indirect light: x2 and its radiance to x1, by a light sample at x2 and by the path's suffix.
// - Light in view: emission that the camera sees, and direct light of mirrors that it sees, itself
//   or in other mirrors: images of lamps. The pass light_edges may take several samples of it.
// - Unresampled light, which no other pixel could reuse: the environment that the camera sees, all
//   other light if x1 cannot be reused (mirror, glass, roughness below the limit), light through a
//   delta lobe at x2, and light of an x2 between two bodies. Which part of the integrand that is
//   depends on x2 alone, so that the split is the same for every pixel.
//
// With RL_PATH_REPLAYS (methods whose shift replays a prefix) all else is resampled: x1 is the
// last vertex before the first pair that connects, and every vertex up to it adds its light samples
// and the emitters that it finds as candidates of their own.
//
// With RL_DIRECT_ONLY (methods that resample direct light) no x2 is reused: light that comes by one
// is unresampled, too, and so is light that the light table does not have.
#define RL_WALK_STATE PathRecord

#include "core/path_sample/path_connect.glsl"
#include "core/transport/light_terms.glsl"

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

// Returns whether x1 is smooth: its light samples and its BSDF sample are candidates of their own,
// with MIS weights.
RL_FN bool pathIsSmoothX1(RL_IN(PathRecord) p) {
#ifdef RL_PATH_REPLAYS
  return p.connector.isRough == 0u;
#else
  return false;
#endif
}

RL_FN float pathLightSamples(RL_IN(PathRecord) p) {
#ifdef RL_PATH_REPLAYS
  if (p.base > 0u) return 1.0f;
#endif
  return float(gParams.path.lightCandidates);
}

// Density of the light samples of one pixel plus that of its BSDF sample (pdfSolidAngle towards the
// light), in the measure of the light sample (area, solid angle of the environment, discrete).
RL_FN float pathDirectDensity(RL_IN(PathRecord) p, RL_IN(LightSample) light,
                              RL_IN(LightConnection) c, float pdfSolidAngle) {
  float density = pathLightSamples(p) * light.pdf;
  if (!c.isDelta && !pathHasUnshadowedTarget() && !pathIsSmoothX1(p))
    density += pdfSolidAngle * c.geometry;
  return density;
}

RL_FN PathRecord pathRecordEmpty(uint film) {
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  PathRecord p;
  p.unresampledRadiance = zero;
  p.inView = zero;
  p.isMirrored = 1u;
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
  p.isX2Unresampled = 0u;
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
  p.isLightUnresampled = 0u;
  p.base = 0u;
  p.key = 0u;
  p.connector = pathConnectorNone();
  p.prefix = vec3(1.0f, 1.0f, 1.0f);
  p.roulette = 1.0f;
  p.sigmaX1 = zero;
  p.rankX1 = gFrame.cameraMedia.x;
  p.chosen.path = p.x2;
  p.chosen.state = reservoirEmpty();
  p.wSum = 0.0f;
  p.estimate = zero;
  return p;
}

RL_FN void pathReachesX2(RL_INOUT(PathRecord) p, RL_IN(Surface) s) {
  p.x2.id = s.id;
  p.x2.kind = RL_PATH_LAMBERT | (s.isFront != 0u ? 0u : RL_PATH_BACK);
  p.x2.geometry = shiftGeometryTerm(s.posW, s.nGeoW, p.x1PosW);
  p.surfaceX2 = s;
  // Absorption up to here is in the throughput up to x1, and in the segment to x2.
  p.suffixThroughput = vec3(1.0f, 1.0f, 1.0f);
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
  return p.isReusable != 0u && walk.bounces == p.base;
}
RL_FN bool pathHasLeftX1(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.isReusable != 0u && walk.bounces == p.base + 1u;
}
RL_FN bool pathIsAtX2(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return pathHasLeftX1(p, walk) && p.isX2Unresampled == 0u;
}
RL_FN bool pathIsAtX3(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.isSuffix != 0u && walk.bounces == p.base + 2u;
}
RL_FN bool pathHasLeftX2(RL_IN(PathRecord) p, RL_IN(Walk) walk) {
  return p.hasX2 != 0u && walk.bounces == p.base + 2u;
}

// Returns whether a reservoir can name the light that the ray from x1 met.
RL_FN bool pathCanName(uint light) {
#ifdef RL_DIRECT_ONLY
  return light != RL_INVALID;
#else
  return true;
#endif
}

// Adds the light that a smooth x1 found, which no other pixel could reconnect to: a candidate that
// is replayed as a whole. Returns whether it was such light.
RL_FN bool pathAddReplay(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(vec3) radiance,
                         float pdfLight) {
#ifdef RL_PATH_REPLAYS
  if (!pathHasLeftX1(p, walk) || !pathIsSmoothX1(p)) return false;
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  vec3 F = walk.throughput * (1.0f / p.roulette) * radiance * weight;
  p.estimate += F * p.roulette;
  if (risAccept(p.wSum, rlLuminance(F) * p.roulette, rngDraw(walk.rng, RL_DIM_RIS_REPLAY))) {
    p.chosen.path = pathOfLight(pathNoLight(), p.film);
    p.chosen.path.kind = RL_PATH_WHOLE_REPLAY;
    p.chosen.path.base = p.base;
    p.chosen.state.F = F;
  }
  return true;
#else
  return false;
#endif
}

RL_FN void onMiss(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(vec3) radiance, float pdfLight) {
  if (pathAddReplay(p, walk, radiance, pdfLight)) return;
  bool isScattered = RL_HAS(RL_FEATURE_SCATTERING) && walk.isScattered != 0u;
  if (pathIsAtX2(p, walk) && pathCanName(gScene.environmentLight) && !isScattered) {
    p.alphaTransmittanceX1 = walk.passed;
    p.found.kind = RL_LIGHT_ENVIRONMENT;
    p.found.record = gScene.environmentLight;
    p.found.point = walk.ray.dir;
    p.found.pdf = pdfLight;
    p.found.radiance = radiance;
    p.bsdfHitIntegrand = p.fX1 * radiance;
    p.bsdfHitWeight = rlLuminance(p.bsdfHitIntegrand) * p.roulette *
                      rlSafeDivide(1.0f, pathLightSamples(p) * pdfLight + p.pdfX1);
  } else if (pathIsAtX3(p, walk)) {
    p.emittedAtX3 = radiance * p.suffixThroughput;
    p.pdfLightAtX3 = pathPackedPdf(pdfLight);
  } else if (walk.bounces == 0u) {
    p.unresampledRadiance = walk.throughput * radiance;
  } else {
    pathAddLight(p, walk,
                 radiance * (pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f));
  }
}

RL_FN void onEmission(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(Hit) hit,
                      float pdfLight) {
  if (p.isMirrored != 0u) {
    p.inView += lightFound(walk, s.emission, pdfLight);
    return;
  }
  if (pathAddReplay(p, walk, s.emission, pdfLight)) return;
  bool isScattered = RL_HAS(RL_FEATURE_SCATTERING) && walk.isScattered != 0u;
  if (pathIsAtX2(p, walk) && pathCanName(s.light) && !isScattered) {
    p.alphaTransmittanceX1 = walk.passed;
    float cosLight = abs(dot(s.nGeoW, walk.ray.dir));
    float geometry = cosLight / (hit.t * hit.t);
    p.found.kind = RL_LIGHT_AREA;
    p.found.id = s.id;
    p.found.record = s.light;
    p.found.point = s.posW;
    p.found.normal = s.nGeoW;
    p.found.posError = s.posError;
    p.found.pdf = pdfLight * geometry;
    p.found.radiance = s.emission;
    if (RL_HAS(RL_FEATURE_ALPHA)) {
      p.bsdfHitCoverage = surfaceAlpha(hit);
      p.found.radiance *= p.bsdfHitCoverage;
    }
    // Unlit surfaces and ambient light are not in the light table and shine to both sides. Lamps
    // of shapes without draws are not in it, either.
    p.found.isTwoSided = RL_MATERIAL_DOUBLE_SIDED;
    if (s.light != RL_INVALID) {
      p.found.isTwoSided = recordLight(s.light).flags & RL_MATERIAL_DOUBLE_SIDED;
    } else if (RL_HAS_SHAPES) {
      Material m = recordMaterial(recordInstance(s.id.instance).material);
      bool isLamp = (m.flags & RL_MATERIAL_UNLIT) == 0u && rlLuminance(m.emission) > 0.0f;
      if (isLamp) p.found.isTwoSided = m.flags & RL_MATERIAL_DOUBLE_SIDED;
    }
    p.bsdfHitIntegrand = p.fX1 * s.emission * geometry;
#ifdef RL_PATH_REPLAYS
    p.bsdfHitIntegrand *= p.mediumTransmittance;
#endif
    p.bsdfHitWeight = rlLuminance(p.bsdfHitIntegrand) * p.roulette *
                      rlSafeDivide(1.0f, (pathLightSamples(p) * pdfLight + p.pdfX1) * geometry);
  } else if (pathIsAtX3(p, walk)) {
    p.emittedAtX3 = s.emission * p.suffixThroughput;
    p.pdfLightAtX3 = pathPackedPdf(pdfLight);
  } else {
    float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
    // Light samples of a rough x1 have this hit's density in theirs (pathDirectDensity()).
    if (isScattered && pdfLight > 0.0f && pathIsAtX2(p, walk) && !pathIsSmoothX1(p))
      weight =
          pathHasUnshadowedTarget() ? 0.0f : p.pdfX1 / (pathLightSamples(p) * pdfLight + p.pdfX1);
    pathAddLight(p, walk, s.emission * weight);
  }
}

RL_FN void onMedium(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(vec3) transmittance) {
  p.mediumTransmittance = transmittance;
  p.suffixThroughput *= transmittance;
}

// Returns whether no path is reconnected at this x2: its id does not tell the bodies beside it, or
// the light that it sends to x1 does not travel straight.
RL_FN bool pathIsBetweenBodies(RL_IN(Walk) walk, RL_IN(Surface) x2) {
#ifdef RL_DIRECT_ONLY
  return true;
#else
  bool isScattered = RL_HAS(RL_FEATURE_SCATTERING) && walk.isScattered != 0u;
  return isScattered || (RL_HAS(RL_FEATURE_VOLUME) && x2.contrast > 0.0f);
#endif
}

// At x2, the radiance leaves in every direction, as from a Lambert surface.
RL_FN void onEnd(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(vec3) radiance) {
  bool isApart = pathIsBetweenBodies(walk, s);
#ifdef RL_PATH_REPLAYS
  if (pathHasLeftX1(p, walk)) isApart = !pathConnects(p.connector, walk, s);
#endif
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

#include "core/path_sample/path_direct.glsl"

#ifdef RL_PATH_REPLAYS
// Begins to gather the candidates of a vertex as x1.
RL_FN void pathBeginX1(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Surface) s) {
  p.base = walk.bounces;
  p.prefix = walk.throughput * (1.0f / p.roulette);
  p.connector.posW = s.posW;
  p.connector.isRough = pathIsRough(s) ? 1u : 0u;
  p.sigmaX1 = walk.sigma;
  p.rankX1 = walk.media.x;
  p.x1PosW = s.posW;
  p.x1NGeoW = s.nGeoW;
  p.x1PosError = s.posError;
  p.light = pathNoLight();
  p.lightSum = 0.0f;
  p.lightF = vec3(0.0f, 0.0f, 0.0f);
  p.bsdfHitIntegrand = p.lightF;
  p.bsdfHitWeight = 0.0f;
  p.bsdfHitCoverage = 1.0f;
}
#endif

RL_FN uint onVertex(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  if (!pathIsMirror(s)) p.isMirrored = 0u;
#ifdef RL_PATH_REPLAYS
  if (walk.bounces == 0u) {
    p.isReusable = (gFrame.cameraAbsorbs & RL_CAMERA_ABSORBS_NOW) == 0u ? 1u : 0u;
    if (p.isReusable == 0u) RL_HEALTH(RL_HEALTH_UNREUSABLE_PIXELS);
    p.connector.footprint = pathFootprintOfX1(s, walk.ray.origin);
    pathBeginX1(p, walk, s);
    bool isOne = p.isReusable == 0u || p.isMirrored != 0u || pathIsLightUnresampled(s);
    return isOne ? 1u : gParams.path.lightCandidates;
  }
  if (pathHasLeftX1(p, walk)) {
    p.alphaTransmittanceX1 = walk.passed;
    if (pathConnects(p.connector, walk, s)) {
      p.fX1 *= p.mediumTransmittance;
    } else {
      Rng rng = walk.rng;
      rng.vertex = p.base + 1u;
      pathAddDirect(p, pathAlphaTransmittance(p), rng);
      if (p.base < gParams.path.mostReplayed) {
        pathBeginX1(p, walk, s);
      } else {
        p.isReusable = 0u;
      }
    }
  }
  return 1u;
#else
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
    if (pathIsBetweenBodies(walk, s)) p.isX2Unresampled = 1u;
  }
  return pathIsAtX1(p, walk) ? gParams.path.lightCandidates : 1u;
#endif
}

RL_FN bool onLightSample(RL_INOUT(PathRecord) p, RL_IN(Walk) walk, RL_IN(Rng) rng, RL_IN(Surface) s,
                         RL_IN(LightSample) light, RL_IN(LightConnection) c) {
  if (p.isMirrored != 0u) {
    vec3 unshadowed;
    bool isReflected = lightSampled(walk, s, light, c, unshadowed);
    p.unshadowedContribution = unshadowed;
    return isReflected;
  }
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  p.isLightUnresampled = pathIsLightUnresampled(s) ? 1u : 0u;
  if (pathIsAtX1(p, walk) && p.isLightUnresampled == 0u) {
    vec3 integrand = f * c.emitted * c.geometry;
#ifdef RL_PATH_REPLAYS
    integrand *= p.prefix;
    if (RL_HAS(RL_FEATURE_VOLUME)) integrand *= exp(-p.sigmaX1 * c.distance);
    if (pathIsSmoothX1(p) && !c.isDelta) integrand *= lightMisWeight(c.pdfSolidAngle, pdf);
#endif
    real w = rlLuminance(integrand) * p.roulette *
             rlSafeDivide(1.0f, pathDirectDensity(p, light, c, pdf));
    if (!risAccept(p.lightSum, w, rngDraw(rng, RL_DIM_RIS_LIGHT))) return false;
    p.light = light;
    p.lightF = integrand;
    return !pathHasUnshadowedTarget();
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
  if (p.isMirrored != 0u) {
    p.inView += p.unshadowedContribution * transmittance;
  } else if (pathHasLeftX1(p, walk) && p.isLightUnresampled == 0u) {
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
    p.fX1 = draw.weight * draw.pdfSolidAngle * p.prefix;
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
#ifdef RL_PATH_REPLAYS
  if (p.hasX2 == 0u) p.roulette *= factor;
  if (p.hasX2 == 0u) return;
#endif
  p.suffixThroughput *= factor;
}

#include "core/transport/walk.glsl"
