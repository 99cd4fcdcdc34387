// Bodies around lights, and media that scatter.

// A ray to where a light's path begins, from outside of the scene: the bodies that it enters and
// does not leave hold the light.
RL_FN Ray bdptProbe(RL_IN(BdptStart) start, RL_IN(Ray) first) {
  vec3 away = first.dir;
  if (start.kind == RL_LIGHT_AREA)
    away = dot(start.normal, first.dir) > 0.0f ? start.normal : -start.normal;
  vec3 d = first.origin - bdptCentre();
  Ray probe;
  probe.tMin = 0.0f;
  probe.tMax = 2.0f * bdptRadius() + sqrt(dot(d, d));
  probe.origin = first.origin + away * probe.tMax;
  probe.dir = -away;
  return probe;
}

// Returns whether the next ray of a path begins in a medium that scatters.
RL_FN bool bdptIsInScattering(RL_IN(BdptPath) path) {
  return !rlIsBlack(vec3(mediaScattering(path.media.x)));
}

// Where the camera's path travels in a medium that scatters: draws whether it collides before
// `distance` (m), and if so, moves it to the collision and turns it. One channel decides how far,
// all three are weighed (spectral MIS; Wilkie et al. 2014).
RL_FN bool bdptCollides(RL_INOUT(BdptPath) path, float distance) {
  vec4 medium = mediaScattering(path.media.x);
  vec3 scattering = vec3(medium);
  vec3 share = path.throughput * scattering;
  float total = share.x + share.y + share.z;
  if (!(total > 0.0f)) return false;
  path.isScattered = max(path.isScattered, 1u);
  share = share * (1.0f / total);
  Rng rng = path.rng;
  rng.vertex = rng.vertex + RL_VERTEX_COLLISION * (1u + path.stretches);
  path.stretches = path.stretches + 1u;
  float uChannel = rngDraw(rng, RL_DIM_COLLISION_CHANNEL);
  float uDistance = rngDraw(rng, RL_DIM_COLLISION_DISTANCE);
  float sigma = path.sigma.z;
  if (uChannel < share.x + share.y) sigma = path.sigma.y;
  if (uChannel < share.x) sigma = path.sigma.x;
  float travelled = -log(1.0f - uDistance) / sigma;
  bool collides = travelled < distance;
  // Stay inside of the body: rounding would put a collision at its surface outside.
  vec3 size = abs(path.ray.origin) + vec3(distance, distance, distance);
  travelled = min(travelled, max(distance - 4.0e-7f * rlMax3(size), 0.0f));
  vec3 passes = exp(-path.sigma * (collides ? travelled : distance));
  vec3 density = passes;
  vec3 value = passes;
  if (collides) {
    density = path.sigma * passes;
    value = scattering * passes;
  }
  path.throughput *= value * rlSafeDivide(1.0f, dot(share, density));
  if (!collides) return false;
  path.isScattered = 2u;
  vec2 u;
  u.x = rngDraw(rng, RL_DIM_PHASE_U);
  u.y = rngDraw(rng, RL_DIM_PHASE_V);
  path.ray.origin += path.ray.dir * travelled;
  // A camera inside of a body with a diffusion profile: coefficients there stand for no direction.
  float g = medium.w == RL_PHASE_DIFFUSION ? 0.0f : medium.w;
  path.ray.dir = mediaPhaseDraw(path.ray.dir, g, u);
  if (path.stretches >= RL_MOST_STRETCHES) {
    path.isAlive = 0u;
    if (rlMax3(path.throughput) > 1.0e-4f) RL_HEALTH(RL_HEALTH_LONG_WALKS);
  }
  return true;
}

// The state of core/transport/walk.glsl that a diffusion profile looks at.
RL_FN Walk bdptWalkOf(RL_IN(BdptPath) path) {
  Walk walk;
  walk.rng = path.rng;
  walk.film = 0u;
  walk.ray = path.ray;
  walk.bounces = path.events;
  walk.throughput = path.throughput;
  walk.media = path.media;
  walk.sigma = path.sigma;
  walk.passedT = 0.0f;
  walk.pdfBsdf = 0.0f;
  walk.rouletteStart = RL_INVALID;
  walk.passed = 1.0f;
  walk.isScattered = path.isScattered;
  walk.stretches = path.stretches;
  walk.ofMedium = path.throughput;
  walk.last.posW = path.s.posW;
  walk.last.isTwoSided = 1u;
  walk.last.normalW = path.s.nGeoW;
  walk.isAlive = 1u;
  return walk;
}

// Moves the camera's path from where it has entered a body with a diffusion profile to where light
// comes out of it. Returns false if nowhere.
RL_FN bool bdptExit(RL_INOUT(BdptPath) path, RL_INOUT(Hit) hit, RL_OUT(float) eta) {
  Walk walk = bdptWalkOf(path);
  vec3 factor = diffusionFindExit(walk, hit, eta);
  path.ray = walk.ray;
  path.media = walk.media;
  path.sigma = walk.sigma;
  path.stretches = walk.stretches;
  path.isScattered = 2u;
  path.throughput *= factor;
  return hit.instance != RL_INVALID && !rlIsBlack(factor);
}
