// A diffusion profile in place of a random walk: light that enters a body leaves it somewhere near,
// to all sides alike. It has less noise than the walk, and a bias of its own: the profile is that
// of a flat body without an end, whatever the shape (Christensen and Burley, "Approximate
// Reflectance Profiles for Efficient Subsurface Scattering", 2015).

// Returns whether light that has just entered a body leaves it by a profile.
RL_FN bool diffusionApplies(RL_IN(Walk) walk) {
  return walk.bounces > 0u && mediaScattering(walk.media.x).w == RL_PHASE_DIFFUSION;
}

// Share of diffuse light from outside that passes a surface: the mean of 1 - F, by eight values of
// F at squares of equal steps (error below 4e-4). eta: index inside over that outside.
RL_FN float diffusionPasses(float eta) {
  if (abs(eta - 1.0f) < RL_CLEAR_CONTRAST) return 1.0f;
  float ratio = max(eta, 1.0f / eta);  // that of the side where no light is reflected totally
  float sum = 0.0f;
  float weight = 0.0f;
  for (uint i = 0u; i < 8u; i = i + 1u) {
    float t = (float(i) + 0.5f) * 0.125f;
    weight += t * t * t;
    sum += t * t * t * (1.0f - fresnelDielectric(t * t, ratio));
  }
  return sum / weight * (eta < 1.0f ? eta * eta : 1.0f);
}

// How much light comes out of a body without an end, and how far from where it entered. x: share of
// the light that entered under the cosine mu, inside; y: scale of the profile over the mean free
// path. w: albedo of a collision. inner: share that the surface reflects back inside, which spreads
// anew: squares of distances add up. Sources: Hapke's approximation of Chandrasekhar's H (2002),
// van de Hulst's albedo under diffuse light (1980), Christensen and Burley (2015), equation 6.
RL_FN vec2 diffusionOf(float w, float mu, float inner) {
  float s = sqrt(max(1.0f - w, 0.0f));
  float r0 = (1.0f - s) / (1.0f + s);
  float first = 1.0f - s / (1.0f - w * mu * (r0 + (0.5f - r0 * mu) * log((1.0f + mu) / mu)));
  float again = (1.0f - s) * (1.0f - 0.139f * s) / (1.0f + 1.17f * s);
  float rounds = 1.0f / (1.0f - inner * again);
  float off = first - 0.8f;
  return vec2(first * (1.0f - inner) * rounds, sqrt(rounds) / (1.9f - first + 3.5f * off * off));
}

// Density per area (m^-2) of the distance r (m) to the point of exit.
RL_FN float diffusionProfile(float r, float scale) {
  float x = r / scale;
  return (exp(-x) + exp(-x * (1.0f / 3.0f))) / (8.0f * RL_PI * scale * r);
}

// Finds where light leaves the body that the walk has just entered: on a line across the surface,
// at a distance drawn from the profile of one channel, one surface of the body by chance. The line
// runs along the normal or a tangent; all three, and all channels, are weighed together (King et
// al., "BSSRDF Importance Sampling", 2013). Moves the walk out of the body, as if it came to
// the point of exit from outside. Returns the factor on its throughput. eta:
// index inside over that outside.
RL_FN vec3 diffusionFindExit(RL_INOUT(Walk) walk, RL_OUT(Hit) chosen, RL_OUT(float) eta) {
  chosen = traceNoHit();
  vec3 nowhere = vec3(0.0f, 0.0f, 0.0f);
  uint rank = walk.media.x;
  vec3 w = vec3(mediaScattering(rank));
  vec3 sigma = walk.sigma;
  walk.media = mediaLeave(walk.media, rank);
  walk.sigma = vec3(mediaOfRank(walk.media.x));
  walk.isScattered = 1u;
  w = vec3(rlSafeDivide(w.x, sigma.x), rlSafeDivide(w.y, sigma.y), rlSafeDivide(w.z, sigma.z));
  eta = mediaOfRank(rank).w / mediaOfRank(walk.media.x).w;
  // The share that passes outwards is that inwards over eta^2; the rest is sent back inside.
  float inner = 1.0f - diffusionPasses(eta) / (eta * eta);
  float mu = clamp(abs(dot(walk.ray.dir, walk.last.normalW)), 1.0e-3f, 1.0f);
  vec2 ofX = diffusionOf(w.x, mu, inner);
  vec2 ofY = diffusionOf(w.y, mu, inner);
  vec2 ofZ = diffusionOf(w.z, mu, inner);
  vec3 albedo = vec3(ofX.x, ofY.x, ofZ.x);
  vec3 scale = vec3(ofX.y / sigma.x, ofY.y / sigma.y, ofZ.y / sigma.z);
  vec3 share = walk.ofMedium * albedo;  // as in walkCollides()
  float total = share.x + share.y + share.z;
  if (!(total > 0.0f)) return nowhere;
  share = share * (1.0f / total);

  Rng rng = walk.rng;
  rng.vertex = rng.vertex + RL_VERTEX_COLLISION * (1u + walk.stretches);
  walk.stretches = walk.stretches + 1u;
  float uChannel = rngDraw(rng, RL_DIM_COLLISION_CHANNEL);
  float own = uChannel < share.x ? scale.x : uChannel < share.x + share.y ? scale.y : scale.z;
  // The profile is a sum of two exponential functions: 1/4 of the light in the narrow one.
  float uRadius = rngDraw(rng, RL_DIM_COLLISION_DISTANCE);
  float r = uRadius < 0.25f ? -own * log(1.0f - 4.0f * uRadius)
                            : -3.0f * own * log((1.0f - uRadius) * (4.0f / 3.0f));
  vec2 cs = rlCosSin2Pi(rngDraw(rng, RL_DIM_PHASE_U));
  float uAxis = rngDraw(rng, RL_DIM_PHASE_V);
  float uHit = rngDraw(rng, RL_DIM_EXIT);

  vec3 tangent;
  vec3 bitangent;
  frameFromNormal(walk.last.normalW, tangent, bitangent);
  vec3 axis = walk.last.normalW;
  vec3 side = tangent;
  vec3 other = bitangent;
  if (uAxis >= 0.5f) {
    axis = uAxis < 0.75f ? tangent : bitangent;
    side = uAxis < 0.75f ? bitangent : walk.last.normalW;
    other = uAxis < 0.75f ? walk.last.normalW : tangent;
  }
  float reach = RL_DIFFUSION_REACH * rlMax3(scale);
  vec3 enteredW = walk.last.posW;
  Ray probe = walk.ray;
  probe.dir = axis;
  probe.origin = enteredW + (side * cs.x + other * cs.y) * r - axis * reach;
  probe.tMax = 2.0f * reach;
  float count = 0.0f;
  for (uint i = 0u; i < RL_DIFFUSION_HITS; i = i + 1u) {
    Hit hit = traceNoHit();
    traceRay(probe, RL_RAY_PATH, walk.rng.key.x + i, hit);
    if (hit.instance == RL_INVALID) break;
    SurfaceId id;
    id.instance = hit.instance;
    id.primitive = hit.primitive;
    id.bary = hit.bary;
    SurfacePoint point = surfacePointAt(id);
    if (mediaRank(hit) == rank) {
      count += 1.0f;
      float keeps = 1.0f / count;
      bool isChosen = uHit < keeps;
      uHit = isChosen ? uHit * count : (uHit - keeps) / max(1.0f - keeps, 1.0e-6f);
      if (isChosen) chosen = hit;
    }
    probe.tMax -= hit.t;
    probe.origin = surfaceOffset(point.posW, point.normalW, point.posError, axis);
    if (!(probe.tMax > 0.0f)) break;
  }
  if (!(count > 0.0f)) return nowhere;

  SurfaceId id;
  id.instance = chosen.instance;
  id.primitive = chosen.primitive;
  id.bary = chosen.bary;
  SurfacePoint exitPoint = surfacePointAt(id);
  vec3 d = exitPoint.posW - enteredW;
  vec3 along = vec3(dot(d, walk.last.normalW), dot(d, tangent), dot(d, bitangent));
  vec3 cosine = vec3(abs(dot(exitPoint.normalW, walk.last.normalW)),
                     abs(dot(exitPoint.normalW, tangent)), abs(dot(exitPoint.normalW, bitangent)));
  float d2 = dot(d, d);
  float least = 1.0e-3f * min(scale.x, min(scale.y, scale.z));
  float density = 0.0f;
  for (uint i = 0u; i < 3u; i = i + 1u) {
    float a = i == 0u ? along.x : i == 1u ? along.y : along.z;
    float c = i == 0u ? 2.0f * cosine.x : i == 1u ? cosine.y : cosine.z;
    if (abs(a) > reach) continue;
    float rOf = max(sqrt(max(d2 - a * a, 0.0f)), least);
    density +=
        0.25f * c *
        (share.x * diffusionProfile(rOf, scale.x) + share.y * diffusionProfile(rOf, scale.y) +
         share.z * diffusionProfile(rOf, scale.z));
  }
  float rExit = max(sqrt(d2), least);
  vec3 profile = vec3(diffusionProfile(rExit, scale.x), diffusionProfile(rExit, scale.y),
                      diffusionProfile(rExit, scale.z));
  walk.ray.dir = -exitPoint.normalW;
  walk.ray.origin = exitPoint.posW + exitPoint.normalW * exitPoint.posError;
  chosen.t = 0.0f;
  // Radiance that was refracted into the body comes out of it: its cone is as wide as before.
  return albedo * profile * (eta * eta * rlSafeDivide(count, density));
}

// Makes the surface at the point of exit one that sends light to all sides alike, as far as it
// passes the surface and its tint.
RL_FN void diffusionLoadExit(RL_INOUT(Surface) s, float eta) {
  vec3 tint = s.bsdf.transmission;
  s.emission = vec3(0.0f, 0.0f, 0.0f);
  s.light = RL_INVALID;
  s.bsdf = bsdfNone();
  s.bsdf.diffuse = tint * (1.0f / diffusionPasses(eta));
  s.bsdf.lobes = rlIsBlack(tint) ? 0u : RL_LOBE_DIFFUSE | RL_LOBE_EXIT;
  s.bsdf.eta = eta;
}
