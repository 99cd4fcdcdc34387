// bdpt: bidirectional path tracing (Veach 1997, chapter 10). An estimator that shares surfaces,
// BSDFs, cameras and rays with `path`, and nothing of how light is found.
//
// Estimator: from each vertex of the camera's path a light's path of its own begins, and every
// vertex of it is joined to that vertex; the camera itself is joined to one more such path, whose
// light falls on any pixel. So all pairs (s, t) of vertices from a light and from the camera are
// drawn once per pixel, but s = t = 1, which would be light in view: that is found by the camera's
// rays alone. With a filter without extent t = 1 is impossible and left out.
//
// MIS weights: the power or the balance heuristic over all strategies that can make the path, by
// densities per area that are carried along both paths, as ratios of one strategy to the next
// (Veach 1997, section 10.2; Georgiev et al., "Light Transport Simulation with Vertex Connection
// and Merging", 2012, appendix). Any densities will do that are the same from both ends: Russian
// roulette and alpha are left out, and a delta lobe's counts as 1. Unbiased.
//
// Media that absorb dim both paths alike. Those that scatter are entered by the camera's path
// alone. All rays leave from one place of the code, in the turns of one loop.
#include "core/transport/diffusion.glsl"
#include "integrators/bdpt/splat.glsl"
#include "integrators/bdpt/start.glsl"
#include "integrators/bdpt/scatter.glsl"
#include "integrators/bdpt/film.glsl"
#include "integrators/bdpt/join.glsl"
#include "integrators/bdpt/medium.glsl"

RL_FN bool bdptWants(uint events) {
  uint component = events >= 2u ? RL_COMPONENT_INDIRECT : RL_COMPONENT_DIRECT;
  return (gFrame.components & component) != 0u;
}

// Returns whether any lobe can be joined to other vertices.
RL_FN bool bdptIsJoinable(RL_IN(Surface) s) {
  uint lobes = RL_LOBE_DIFFUSE | RL_LOBE_SPECULAR | RL_LOBE_TRANSMISSION | RL_LOBE_COAT |
               RL_LOBE_SHEEN | RL_LOBE_DIFFUSE_TRANSMISSION | RL_LOBE_ROUGH_DIFFUSE;
  return (s.bsdf.lobes & lobes) != 0u;
}

// Light that the camera's path has met at its last vertex: s = 0.
RL_FN vec3 bdptFound(RL_IN(BdptPath) eye) {
  if ((gParams.strategies & RL_BDPT_EMISSION) == 0u) return vec3(0.0f, 0.0f, 0.0f);
  float weight = 1.0f;
  if (eye.s.light != RL_INVALID && eye.events > 1u && gParams.exponent != RL_BDPT_ALONE) {
    float density = bdptLightDensity(eye.s.light, eye.s.id);
    float cosine = abs(dot(eye.s.nGeoW, eye.s.wo));
    bool isTwoSided = (recordLight(eye.s.light).flags & RL_MATERIAL_DOUBLE_SIDED) != 0u;
    float forward = RL_INV_PI * cosine * (isTwoSided ? 0.5f : 1.0f);
    weight = bdptWeight(density, eye.density, eye.joins + bdptPower(forward) * eye.others, 0.0f);
  }
  return eye.throughput * eye.s.emission * weight;
}

// Light of the sky behind everything, where the camera's ray has met nothing.
RL_FN vec3 bdptFoundSky(RL_IN(BdptPath) eye) {
  bool isInView = eye.events == 0u;
  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  if ((gParams.strategies & RL_BDPT_EMISSION) == 0u || !skyExists(isInView)) return radiance;
  float weight = 1.0f;
  if (!isInView && gParams.exponent != RL_BDPT_ALONE) {
    float forward = bdptDensityAcrossAt(eye.s.posW, eye.ray.dir);
    float past = eye.pastOthers * bdptPower(rlSafeDivide(eye.pastCosine, eye.pastDensity));
    float others = eye.pastJoins + bdptPower(forward) * min(past, RL_BDPT_LARGEST);
    weight = bdptWeight(bdptSkyDensity(eye.ray.dir), eye.pdfRay, others, 0.0f);
  }
  return eye.throughput * skyRadiance(eye.ray.dir, isInView) * weight;
}

RL_FN BdptPath bdptNoPath(RL_IN(Rng) rng) {
  BdptPath path;
  path.s = surfaceNone();
  path.throughput = vec3(1.0f, 1.0f, 1.0f);
  path.density = 0.0f;
  path.others = 0.0f;
  path.joins = 0.0f;
  path.events = 0u;
  path.isAlive = 1u;
  path.ray.origin = vec3(0.0f, 0.0f, 0.0f);
  path.ray.tMin = 0.0f;
  path.ray.dir = vec3(0.0f, 0.0f, 1.0f);
  path.ray.tMax = 3.0e38f;
  path.pdfRay = 0.0f;
  path.pastDensity = 1.0f;
  path.pastOthers = 0.0f;
  path.pastCosine = 1.0f;
  path.pastJoins = 0.0f;
  path.isParallel = 0u;
  path.passedT = 0.0f;
  path.media = mediaNone();
  path.behind = mediaNone();
  path.sigma = vec3(0.0f, 0.0f, 0.0f);
  path.isScattered = 0u;
  path.stretches = 0u;
  path.rng = rng;
  return path;
}

// The path of a film sample, before its first ray.
RL_FN BdptPath bdptEyePath(RL_IN(Rng) rng, RL_IN(uvec2) pixel, uint film) {
  BdptPath eye = bdptNoPath(rng);
  eye.ray = cameraFilmRay(gFrame.camera, pixel, film);
  eye.isParallel = gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC ? 1u : 0u;
  eye.pdfRay = bdptFilmDensity(eye.ray.dir);
  eye.pastJoins = bdptSplats() ? 1.0f : 0.0f;
  if (RL_HAS(RL_FEATURE_VOLUME)) {
    eye.media = gFrame.cameraMedia;
    eye.sigma = vec3(mediaOfRank(eye.media.x));
  }
  return eye;
}

// Light that the last vertex of the camera's path sends, and that no other ray has to look for.
RL_FN vec3 bdptSeeLight(RL_IN(BdptPath) eye, bool isExit) {
  uint before = eye.events - 1u;
  if (!rlIsBlack(eye.s.emission) && bdptWants(before)) return bdptFound(eye);
  bool isLit = RL_HAS(RL_FEATURE_AMBIENT) && rlIsBlack(eye.s.emission) && !isExit;
  bool isWanted = before < gFrame.maxBounces && bdptWants(eye.events);
  bool isOn = (gParams.strategies & RL_BDPT_EMISSION) != 0u;
  if (isLit && isWanted && isOn) return eye.throughput * surfaceAmbient(eye.s);
  return vec3(0.0f, 0.0f, 0.0f);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  uint film = cameraFilmBits(pixel);
  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  Rng rngOfLights = rngInit(gFrame.seed ^ 0x6a09e667u, pixelIndex, gFrame.frame);
  BdptPath eye = bdptEyePath(rngInit(gFrame.seed, pixelIndex, gFrame.frame), pixel, film);
  BdptPath light = bdptNoPath(rngOfLights);
  BdptStart start = bdptStartAt(RL_INVALID);
  BdptJoin join = bdptNoJoin();
  Ray probe = eye.ray;
  uint most = gFrame.maxBounces;  // events of a path
  if ((gFrame.components & RL_COMPONENT_INDIRECT) == 0u) most = min(most, 1u);
  uint turn = RL_BDPT_TO_LOOK;
  if (bdptSplats() && lightExists() && most > 0u) turn = RL_BDPT_TO_LIGHT;
  for (;;) {
    // Steps without a ray.
    if (turn == RL_BDPT_TO_LIGHT) {
      light = bdptNoPath(rngOfLights);
      light.rng.vertex = RL_BDPT_VERTEX_LIGHT * (eye.events + 1u);
      start = bdptStart(light.rng);
      turn = start.pdf > 0.0f ? RL_BDPT_TO_JOIN : RL_BDPT_TO_LOOK;
    }
    if (turn == RL_BDPT_TO_JOIN) {
      uint strategy = light.events == 0u ? RL_BDPT_LIGHT : RL_BDPT_CONNECT;
      if (eye.events == 0u) strategy = light.events == 0u ? 0u : RL_BDPT_SPLAT;
      bool joins = bdptWants(eye.events + light.events) && (gParams.strategies & strategy) != 0u;
      if (joins) joins = bdptJoin(eye, light, start, join);
      if (!joins) turn = light.events == 0u ? RL_BDPT_TO_EMIT : RL_BDPT_TO_GO_ON;
    }
    if (turn == RL_BDPT_TO_EMIT) {
      turn = RL_BDPT_TO_LOOK;
      if (eye.events < most) {
        bdptEmit(start, light.rng, light);
        if (light.isAlive != 0u) turn = RL_BDPT_TO_TRACE;
        probe = light.ray;
        if (turn == RL_BDPT_TO_TRACE && bdptIsFar(start)) {
          probe.dir = -light.ray.dir;
          turn = RL_BDPT_TO_SUN;
        } else if (RL_HAS(RL_FEATURE_VOLUME) && turn == RL_BDPT_TO_TRACE) {
          probe = bdptProbe(start, light.ray);
          turn = RL_BDPT_TO_MEDIA;
        }
      }
    }
    if (turn == RL_BDPT_TO_GO_ON || turn == RL_BDPT_TO_LOOK) {
      bool isOfLight = turn == RL_BDPT_TO_GO_ON;
      BdptPath path = eye;
      if (isOfLight) path = light;
      bool ends = isOfLight && eye.events + light.events >= most;
      if (ends) path.isAlive = 0u;
      if (!ends && path.events > 0u) bdptScatter(path, isOfLight);
      // Light samples of `path` do not pass smooth surfaces, and no ray of it finds a point.
      bool isHidden = isOfLight && start.isFindable == 0u && gParams.causticsOfPoints == 0u;
      if (isHidden && path.events == 1u && path.pastJoins == 0.0f) path.isAlive = 0u;
      turn = isOfLight ? RL_BDPT_TO_TRACE : RL_BDPT_TO_FOLLOW;
      if (isOfLight) {
        light = path;
        if (path.isAlive == 0u) {
          turn = RL_BDPT_TO_LOOK;
          continue;
        }
      } else {
        eye = path;
        if (path.isAlive == 0u) break;
      }
    }

    if (RL_HAS(RL_FEATURE_SCATTERING) && turn == RL_BDPT_TO_TRACE && bdptIsInScattering(light)) {
      turn = RL_BDPT_TO_LOOK;
      continue;
    }
    bool isOfLight = turn != RL_BDPT_TO_FOLLOW;
    BdptPath path = eye;
    if (isOfLight) path = light;
    // One ray, whatever it is for.
    Ray traced = path.ray;
    uint mode = RL_RAY_PATH;
    uint key = path.rng.key.x + path.rng.vertex * 0x632be59bu;
    if (!isOfLight && eye.events == 0u) key = cameraAlphaKey(film);
    if (RL_HAS(RL_FEATURE_SCATTERING)) key += path.stretches * 0x9e3779b9u;
    if (turn == RL_BDPT_TO_JOIN) {
      traced = join.ray;
      mode = RL_RAY_SHADOW;
      key = join.rank;
    } else if (turn == RL_BDPT_TO_SUN || turn == RL_BDPT_TO_MEDIA) {
      traced = probe;
      if (turn == RL_BDPT_TO_SUN) {
        mode = RL_RAY_SHADOW;
        key = 0u;
      }
    }
    Hit hit = traceNoHit();
    float exitEta = 1.0f;
    bool isExit = false;
    if (RL_HAS(RL_FEATURE_SCATTERING) && !isOfLight) isExit = diffusionApplies(bdptWalkOf(path));
    float passed = 1.0f;
    if (!isExit) passed = traceRay(traced, mode, key, hit);

    if (mode == RL_RAY_SHADOW) {
      if (turn == RL_BDPT_TO_SUN) {
        light.throughput *= passed;
        turn = passed > 0.0f ? RL_BDPT_TO_TRACE : RL_BDPT_TO_LOOK;
      } else {
        vec3 joined = join.unshadowed * passed;
        if (eye.events == 0u) {
          bdptSplat(join.pixel, joined);
        } else {
          radiance += joined;
        }
        turn = light.events == 0u ? RL_BDPT_TO_EMIT : RL_BDPT_TO_GO_ON;
      }
      continue;
    }
    if (RL_HAS(RL_FEATURE_SCATTERING) && isExit && !bdptExit(path, hit, exitEta)) break;
    if (hit.instance == RL_INVALID) {
      if (!isOfLight) {
        if (bdptWants(eye.events)) radiance += bdptFoundSky(eye);
        break;
      }
      turn = turn == RL_BDPT_TO_MEDIA ? RL_BDPT_TO_TRACE : RL_BDPT_TO_LOOK;
      continue;
    }
    if (RL_HAS(RL_FEATURE_SCATTERING) && !isOfLight && !isExit && bdptCollides(path, hit.t)) {
      path.passedT = 0.0f;
      eye = path;
      if (eye.isAlive == 0u) break;
      continue;
    }
    MediaCrossing crossing;
    crossing.behind = path.media;
    crossing.contrast = 0.0f;
    crossing.isSurface = 1u;
    crossing.isTouching = 0u;
    if (RL_HAS(RL_FEATURE_VOLUME) && !isExit) crossing = mediaCross(path.media, traced, hit);
    Surface s = surfaceLoadBetween(hit, traced.dir, crossing.contrast);
    if (RL_HAS(RL_FEATURE_VOLUME)) {
      s.sigmaBeyond = vec3(mediaOfRank(crossing.behind.x));
      if (crossing.isTouching != 0u) s.posError *= 3.0f;
      vec3 beyond = surfaceOffset(s.posW, s.nGeoW, s.posError, traced.dir);
      if (turn == RL_BDPT_TO_MEDIA) {
        light.media = crossing.behind;
        light.sigma = s.sigmaBeyond;
        probe.origin = beyond;
        probe.tMax -= hit.t;
        if (!(probe.tMax > 0.0f)) turn = RL_BDPT_TO_TRACE;
        continue;
      }
      // Not a surface: the ray goes on. Absorption is applied at the surface where the ray ends.
      if (crossing.isSurface == 0u) {
        path.media = crossing.behind;
        path.passedT += hit.t;
        path.ray.origin = beyond;
        if (isOfLight) {
          light = path;
        } else {
          eye = path;
        }
        continue;
      }
      hit.t += path.passedT;
      path.passedT = 0.0f;
      if (!RL_HAS(RL_FEATURE_SCATTERING) || path.isScattered == 0u)
        path.throughput *= exp(-path.sigma * hit.t);
    }
    path.s = s;
    path.behind = crossing.behind;
    if (RL_HAS(RL_FEATURE_SCATTERING) && isExit) diffusionLoadExit(path.s, exitEta);
    path.events = path.events + 1u;
    path.rng.vertex = path.rng.vertex + 1u;
    bdptArrive(path, hit.t);
    if (RL_HAS(RL_FEATURE_SCATTERING) && path.isScattered != 0u) {
      // Light's paths do not go through the medium.
      path.others = 0.0f;
      if (path.isScattered > 1u) path.joins = 0.0f;
      path.isScattered = 0u;
    }
    bool isBlack = bsdfIsBlack(path.s.bsdf);
    bool isJoinable = bdptIsJoinable(path.s);
    if (isOfLight) {
      if (start.kind == RL_LIGHT_POINT && path.events == 1u) {
        // Light falls off as the scene says.
        float fall = start.normal.x + start.normal.y * hit.t + start.normal.z * hit.t * hit.t;
        path.throughput *= rlSafeDivide(hit.t * hit.t, fall);
      }
      light = path;
      turn = isJoinable ? RL_BDPT_TO_JOIN : RL_BDPT_TO_GO_ON;
      if (isBlack) turn = RL_BDPT_TO_LOOK;
    } else {
      eye = path;
      radiance += bdptSeeLight(eye, isExit);
      if (eye.events > most || isBlack) break;
      turn = isJoinable && lightExists() ? RL_BDPT_TO_LIGHT : RL_BDPT_TO_LOOK;
    }
  }
  if (!rlIsFinite3(radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixelIndex] = radiance;
}
