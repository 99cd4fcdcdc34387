// The path loop. Every kernel that traces paths includes this file and defines what happens to the
// light that a path finds. The loop decides where the path goes, and which rays and random numbers
// are used. At each vertex light samples and one BSDF sample are drawn. Each iteration traces at
// most two rays from one call site: the shadow ray of the last vertex's light sample, then the
// path's own next ray.
//
// The includer defines RL_WALK_STATE, a struct, and before the #include the functions below, which
// get the state as RL_INOUT(RL_WALK_STATE) and the Walk. Vertices are counted as scattering events:
// walk.bounces is 0 at the first one, x1.
//   onMiss(state, walk, radiance, pdfLight)   the ray left the scene: radiance of the
//       environment. pdfLight: solid-angle density of light sampling for the ray; 0 if light
//       sampling does not compete
//   onEmission(state, walk, surface, hit, pdfLight) the ray hit an emitter, s.emission towards it
//   onMedium(state, walk, factor)        transmittance of a medium up to the next vertex, or, in a
//       medium that scatters, what a stretch multiplies the throughput by
//   onVertex(state, walk, surface)              a vertex that scatters, before anything is
//       drawn; returns how many light samples are drawn there, or RL_WALK_ENDS
//   onEnd(state, walk, surface, radiance)  before onVertex: the path ends here, in something that
//       sends `radiance` back along it; only where RL_WALK_END is defined
//   onLightSample(state, walk, rng, surface, light, connection)  a light sample at the vertex,
//   without
//       visibility; returns whether to trace its shadow ray (of several only the last is traced)
//   onShadowRay(state, walk, transmittance)           transmittance of that shadow ray.
//   walk.bounces
//       counts the scattering event at the ray's origin already
//   onBsdfSample(state, walk, surface, draw)       the BSDF sample, before walk.throughput has it
//   onRoulette(state, walk, factor)              Russian roulette: 1 / probability of survival
// RL_WALK_END(state, walk, surface, radiance): returns whether the path ends at a vertex, and sets
// the radiance (core/radiance_cache/termination.glsl). Not defined: no path ends there.
// Only the components of light in gFrame.components are gathered.

#include "core/transport/diffusion.glsl"

RL_FN bool walkWants(uint bounces) {
  uint component = bounces >= 2u ? RL_COMPONENT_INDIRECT : RL_COMPONENT_DIRECT;
  return (gFrame.components & component) != 0u;
}

// Draws light samples. Returns whether there is a shadow ray to trace; only then sets shadowRay.
RL_FN bool walkDrawLights(RL_INOUT(RL_WALK_STATE) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                          uint candidates, RL_INOUT(Ray) shadowRay) {
  bool hasShadowRay = false;
  LightReceiver receiver = lightReceiverAt(s);
  for (uint i = 0u; i < candidates; i = i + 1u) {
    Rng rng = walk.rng;
    if (i > 0u) rng.vertex = RL_VERTEX_CANDIDATES + i;
    LightSample light = lightSample(rng, receiver);
    LightConnection c = lightConnect(light, s.posW);
    if (!(light.pdf > 0.0f) || rlIsBlack(c.emitted)) continue;
    if (onLightSample(state, walk, rng, s, light, c)) {
      shadowRay = lightShadowRay(light, c, s.posW, s.nGeoW, s.posError);
      hasShadowRay = true;
    }
  }
  return hasShadowRay;
}

// Samples the next direction of the path and moves the walk there. behind: bodies beyond the
// surface.
RL_FN void walkScatter(RL_INOUT(RL_WALK_STATE) state, RL_INOUT(Walk) walk, RL_IN(Surface) s,
                       RL_IN(uvec4) behind) {
  float uLobe = rngDraw(walk.rng, RL_DIM_BSDF_LOBE);
  vec2 u;
  u.x = rngDraw(walk.rng, RL_DIM_BSDF_U);
  u.y = rngDraw(walk.rng, RL_DIM_BSDF_V);
  BsdfSample draw = bsdfSample(s.bsdf, s.nGeoW, s.nShadeW, s.wo, uLobe, u);
  walk.isAlive = draw.lobe != 0u && !rlIsBlack(draw.weight) ? 1u : 0u;
  onBsdfSample(state, walk, s, draw);
  walk.throughput *= draw.weight;
  if (walk.isAlive != 0u && walk.bounces + 1u >= walk.rouletteStart) {
    float survival = min(rlMax3(walk.throughput), 0.95f);
    if (rngDraw(walk.rng, RL_DIM_ROULETTE) < survival) {
      walk.throughput *= 1.0f / survival;
      onRoulette(state, walk, 1.0f / survival);
    } else {
      walk.isAlive = 0u;
    }
  }
  walk.pdfBsdf = (draw.lobe & RL_LOBE_ANY_DELTA) != 0u ? 0.0f : draw.pdfSolidAngle;
  if (RL_HAS(RL_FEATURE_VOLUME)) {
    walk.sigma = surfaceSigma(s, walk.sigma, draw.wi);
    if (dot(s.nGeoW, draw.wi) < 0.0f) walk.media = behind;
  }
  walk.ray.origin = surfaceOffset(s.posW, s.nGeoW, s.posError, draw.wi);
  walk.ray.dir = draw.wi;
  walk.isScattered = 0u;
  walk.ofMedium = vec3(1.0f, 1.0f, 1.0f);
  if (RL_HAS(RL_FEATURE_SCATTERING | RL_FEATURE_LIGHT_TREE) || RL_HAS_SHAPES)
    walk.last = lightReceiverAt(s);
}

// Where the ray travels in a medium that scatters: draws whether it collides before `distance`, and
// if so, moves the walk to the collision and turns it. Distances are drawn for one channel, which
// is chosen by the light that it would scatter, and weighed by all three (spectral MIS; Wilkie et
// al. 2014). The light is counted from the last surface: what lies before it has another colour
// where the rest of the path is reused. A light sample from a collision would meet the surface of
// the body, so none is drawn.
RL_FN bool walkCollides(RL_INOUT(RL_WALK_STATE) state, RL_INOUT(Walk) walk, float distance) {
  vec4 medium = mediaScattering(walk.media.x);
  vec3 scattering = vec3(medium);
  vec3 share = walk.ofMedium * scattering;
  float total = share.x + share.y + share.z;
  if (!(total > 0.0f)) return false;
  walk.isScattered = 1u;
  share = share * (1.0f / total);
  Rng rng = walk.rng;
  rng.vertex = rng.vertex + RL_VERTEX_COLLISION * (1u + walk.stretches);
  walk.stretches = walk.stretches + 1u;
  float uChannel = rngDraw(rng, RL_DIM_COLLISION_CHANNEL);
  float sigma = uChannel < share.x             ? walk.sigma.x
                : uChannel < share.x + share.y ? walk.sigma.y
                                               : walk.sigma.z;
  float free = -log(1.0f - rngDraw(rng, RL_DIM_COLLISION_DISTANCE)) / sigma;
  bool collides = free < distance;
  // Stay inside of the body: rounding would put a collision at its surface outside.
  vec3 size = abs(walk.ray.origin) + vec3(distance, distance, distance);
  free = min(free, max(distance - 4.0e-7f * rlMax3(size), 0.0f));
  vec3 passes = exp(-walk.sigma * (collides ? free : distance));
  vec3 density = collides ? walk.sigma * passes : passes;
  vec3 factor = (collides ? scattering * passes : passes) * rlSafeDivide(1.0f, dot(share, density));
  walk.throughput *= factor;
  walk.ofMedium *= factor;
  onMedium(state, walk, factor);
  if (!collides) return false;
  vec2 u;
  u.x = rngDraw(rng, RL_DIM_PHASE_U);
  u.y = rngDraw(rng, RL_DIM_PHASE_V);
  walk.ray.origin += walk.ray.dir * free;
  // A camera inside of a body with a diffusion profile: coefficients there stand for no direction.
  float g = medium.w == RL_PHASE_DIFFUSION ? 0.0f : medium.w;
  walk.ray.dir = mediaPhaseDraw(walk.ray.dir, g, u);
  walk.pdfBsdf = 0.0f;
  if (walk.stretches >= RL_MOST_STRETCHES) {
    walk.isAlive = 0u;
    if (rlMax3(walk.throughput) > 1.0e-4f) RL_HEALTH(RL_HEALTH_LONG_WALKS);
  }
  return true;
}

// Starts a path with a ray, after `bounces` scattering events.
RL_FN Walk walkBegin(RL_IN(Rng) rng, uint film, RL_IN(Ray) ray, uint bounces) {
  Walk walk;
  walk.rng = rng;
  walk.film = film;
  walk.ray = ray;
  walk.bounces = bounces;
  walk.throughput = vec3(1.0f, 1.0f, 1.0f);
  walk.media = mediaNone();
  walk.sigma = vec3(0.0f, 0.0f, 0.0f);
  walk.passedT = 0.0f;
  walk.pdfBsdf = 0.0f;
  walk.rouletteStart = gFrame.rouletteStart;
  walk.passed = 1.0f;
  walk.isScattered = 0u;
  walk.stretches = 0u;
  walk.ofMedium = vec3(1.0f, 1.0f, 1.0f);
  walk.last.posW = ray.origin;
  walk.last.isTwoSided = 1u;
  walk.last.normalW = vec3(0.0f, 0.0f, 1.0f);
  walk.isAlive = 1u;
  return walk;
}

// Traces a path from its next ray to its end.
RL_FN void walkOn(RL_INOUT(RL_WALK_STATE) state, RL_INOUT(Walk) walk) {
  bool hasShadowRay = false;
  Ray shadowRay = walk.ray;
  uint shadowRank = 0u;  // rank of the body that the shadow ray travels in
  for (;;) {
    Hit hit = traceNoHit();
    bool isExit = false;
    float exitEta = 1.0f;
    if (RL_HAS(RL_FEATURE_SCATTERING)) isExit = walk.isAlive != 0u && diffusionApplies(walk);
    for (uint which = 0u; which < 2u; which = which + 1u) {
      bool isShadow = which == 0u;
      if (isShadow ? !hasShadowRay : walk.isAlive == 0u || isExit) continue;
      Ray traced = walk.ray;
      if (isShadow) traced = shadowRay;
      uint mode = isShadow ? RL_RAY_SHADOW : RL_RAY_PATH;
      uint alphaKey = walk.rng.key.x + walk.bounces * 0x632be59bu;
      if (walk.bounces == 0u) alphaKey = cameraAlphaKey(walk.film);
      if (RL_HAS(RL_FEATURE_SCATTERING)) alphaKey += walk.stretches * 0x9e3779b9u;
      if (RL_HAS(RL_FEATURE_VOLUME) && isShadow) alphaKey = shadowRank;
      float passed = traceRay(traced, mode, alphaKey, hit);
      if (isShadow) {
        onShadowRay(state, walk, passed);
      } else {
        walk.passed = passed;
      }
    }
    if (walk.isAlive == 0u) break;
    hasShadowRay = false;

    if (RL_HAS(RL_FEATURE_SCATTERING) && isExit) {
      vec3 factor = diffusionFindExit(walk, hit, exitEta);
      if (hit.instance == RL_INVALID || rlIsBlack(factor)) break;
      walk.passed = 1.0f;
      walk.throughput *= factor;
      walk.ofMedium *= factor;
      onMedium(state, walk, factor);
    }
    if (hit.instance == RL_INVALID) {
      bool isInView = walk.bounces == 0u;
      if (skyExists(isInView) && walkWants(walk.bounces)) {
        vec3 radiance = skyRadiance(walk.ray.dir, isInView);
        float pdfLight = walk.pdfBsdf > 0.0f ? lightPdfOfEnvironment(walk.ray.dir) : 0.0f;
        onMiss(state, walk, radiance, pdfLight);
      }
      break;
    }
    if (RL_HAS(RL_FEATURE_SCATTERING) && !isExit && walkCollides(state, walk, hit.t)) {
      walk.passedT = 0.0f;
      continue;
    }
    MediaCrossing crossing;
    crossing.behind = walk.media;
    crossing.contrast = 0.0f;
    crossing.isSurface = 1u;
    crossing.isTouching = 0u;
    if (RL_HAS(RL_FEATURE_VOLUME) && !isExit) crossing = mediaCross(walk.media, walk.ray, hit);
    Surface s = surfaceLoadBetween(hit, walk.ray.dir, crossing.contrast);
    if (RL_HAS(RL_FEATURE_VOLUME)) {
      s.sigmaBeyond = vec3(mediaOfRank(crossing.behind.x));
      if (crossing.isTouching != 0u) s.posError *= 3.0f;
      // Not a surface: the ray goes on. Absorption is applied at the surface where the ray ends.
      if (crossing.isSurface == 0u) {
        walk.media = crossing.behind;
        walk.passedT += hit.t;
        walk.ray.origin = surfaceOffset(s.posW, s.nGeoW, s.posError, walk.ray.dir);
        continue;
      }
      hit.t += walk.passedT;
      walk.passedT = 0.0f;
      if (!RL_HAS(RL_FEATURE_SCATTERING) || walk.isScattered == 0u) {
        vec3 transmittance = exp(-walk.sigma * hit.t);
        walk.throughput *= transmittance;
        onMedium(state, walk, transmittance);
      }
    }
    if (RL_HAS(RL_FEATURE_SCATTERING) && isExit) diffusionLoadExit(s, exitEta);
    if (!rlIsBlack(s.emission) && walkWants(walk.bounces)) {
      float pdfLight = 0.0f;
      if (walk.pdfBsdf > 0.0f && s.light != RL_INVALID)
        pdfLight = lightPdfOfHit(s.light, s.id, walk.last, s.nGeoW, walk.ray.dir, hit.t);
      onEmission(state, walk, s, hit, pdfLight);
    } else if (RL_HAS(RL_FEATURE_AMBIENT) && rlIsBlack(s.emission) && !isExit &&
               walk.bounces < gFrame.maxBounces && walkWants(walk.bounces + 1u)) {
      // A scattering event of its own, whose light no ray has to look for.
      // It has nothing to do with the light table: the back of a lamp is none.
      Surface lit = s;
      lit.light = RL_INVALID;
      lit.emission = surfaceAmbient(s);
      if (!rlIsBlack(lit.emission)) onEmission(state, walk, lit, hit, 0.0f);
    }
    if (walk.bounces >= gFrame.maxBounces || bsdfIsBlack(s.bsdf)) break;
    walk.rng.vertex = walk.bounces + 1u;
#ifdef RL_WALK_END
    vec3 sentBack;
    if (!isExit && RL_WALK_END(state, walk, s, sentBack)) {
      onEnd(state, walk, s, sentBack);
      break;
    }
#endif
    uint candidates = onVertex(state, walk, s);
    if (candidates == RL_WALK_ENDS) break;
    if (lightExists() && walkWants(walk.bounces + 1u))
      hasShadowRay = walkDrawLights(state, walk, s, candidates, shadowRay);
    if (RL_HAS(RL_FEATURE_VOLUME)) {
      shadowRank = walk.media.x;
      if (dot(s.nGeoW, shadowRay.dir) < 0.0f) shadowRank = crossing.behind.x;
    }
    walkScatter(state, walk, s, crossing.behind);
    walk.bounces = walk.bounces + 1u;
  }
}

// Traces the path of a pixel in this frame, from its film sample (cameraFilmBits) to its end.
RL_FN void walkPathBy(RL_INOUT(RL_WALK_STATE) state, RL_IN(Rng) rng, RL_IN(uvec2) pixel,
                      uint film) {
  Walk walk = walkBegin(rng, film, cameraFilmRay(gFrame.camera, pixel, film), 0u);
  if (RL_HAS(RL_FEATURE_VOLUME)) {
    walk.media = gFrame.cameraMedia;
    walk.sigma = vec3(mediaOfRank(walk.media.x));
  }
  walkOn(state, walk);
}

RL_FN void walkPath(RL_INOUT(RL_WALK_STATE) state, RL_IN(uvec2) pixel, uint film) {
  walkPathBy(state, rngInit(gFrame.seed, pixelIndexOf(pixel), gFrame.frame), pixel, film);
}
