// Joins the last vertices of a camera's path and of a light's.

// Weight of a strategy against all others: those that end the camera's path earlier, by the ratio
// of the densities of its last vertex from the light and from the camera, and `beyond`, those that
// end the light's path earlier.
RL_FN float bdptWeight(float forward, float density, float others, float beyond) {
  float weight = 1.0f + beyond;
  if (others > 0.0f) weight += bdptPower(rlSafeDivide(forward, density)) * others;
  return 1.0f / min(weight, RL_BDPT_LARGEST);
}

RL_FN BdptJoin bdptNoJoin() {
  BdptJoin join;
  join.unshadowed = vec3(0.0f, 0.0f, 0.0f);
  join.ray.origin = vec3(0.0f, 0.0f, 0.0f);
  join.ray.tMin = 0.0f;
  join.ray.dir = vec3(0.0f, 0.0f, 1.0f);
  join.ray.tMax = 1.0f;
  join.rank = 0u;
  join.pixel = 0u;
  return join;
}

// Rank of the body that a ray travels in which leaves the last vertex of a path.
RL_FN uint bdptRankTowards(RL_IN(BdptPath) path, RL_IN(vec3) dirW) {
  return dot(path.s.nGeoW, dirW) >= 0.0f ? path.media.x : path.behind.x;
}

// Computes what the two paths bring if nothing is between them. At the camera's own vertex: what
// it adds to the pixel that shows the light's path. Returns false if it is nothing.
RL_FN bool bdptJoin(RL_IN(BdptPath) eye, RL_IN(BdptPath) light, RL_IN(BdptStart) start,
                    RL_INOUT(BdptJoin) join) {
  bool isAtCamera = eye.events == 0u;
  bool isAtStart = light.events == 0u;
  bool isFar = isAtStart && bdptIsFar(start);
  bool isParallel = isFar || (isAtCamera && gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC);
  vec3 there = light.s.posW;
  if (isAtStart) there = start.point;
  vec3 here = eye.s.posW;
  float film = 1.0f;
  if (isAtCamera && !bdptSeenBy(there, join.pixel, here)) return false;
  vec3 d = there - here;
  if (isFar) d = start.point;
  float d2 = dot(d, d);
  if (!(d2 > 0.0f)) return false;
  float distance = sqrt(d2);
  vec3 dirW = d * (1.0f / distance);  // from the camera's path to the light's
  if (isAtCamera) film = bdptFilmDensity(dirW);
  float area = isParallel ? 1.0f : 1.0f / d2;
  if (isFar) distance = 0.0f;
  float cosHere = abs(dot(eye.s.nGeoW, dirW));
  float cosThere = abs(dot(light.s.nGeoW, dirW));
  if (isAtStart) cosThere = start.kind == RL_LIGHT_AREA ? abs(dot(start.normal, dirW)) : 1.0f;

  vec3 value = eye.throughput * film;
  if (isAtStart) {
    float scale = start.kind == RL_LIGHT_AREA ? cosThere * area : 1.0f;
    value *= bdptEmitted(start, -dirW, distance) * (scale / start.pdf);
  } else {
    float reached = abs(dot(light.s.nGeoW, light.s.wo));
    value *= light.throughput * (cosThere * area * rlSafeDivide(1.0f, reached));
  }
  if (rlIsBlack(value)) return false;
  // Densities of leaving the last vertex of each path for the other's, and of the way back.
  float leavesHere = film;
  float backHere = 0.0f;
  float leavesThere = 0.0f;
  float backThere = 0.0f;
  if (isAtStart) leavesThere = bdptDirectionDensity(start, -dirW, eye.s.posW);
  for (uint i = isAtCamera ? 1u : 0u; i < (isAtStart ? 1u : 2u); i = i + 1u) {
    bool isThere = i == 1u;
    Surface s = eye.s;
    vec3 towards = dirW;
    if (isThere) {
      s = light.s;
      towards = -dirW;
    }
    float leaves;
    float back;
    value *= bdptEval(s, towards, isThere, leaves, back);
    if (isThere) {
      leavesThere = leaves;
      backThere = back;
    } else {
      leavesHere = leaves;
      backHere = back;
    }
  }
  if (rlIsBlack(value)) return false;

  if (isAtCamera)
    join.rank = bdptRankTowards(light, -dirW);
  else
    join.rank = bdptRankTowards(eye, dirW);
  bool scatters = false;  // the medium between the two
  if (RL_HAS(RL_FEATURE_SCATTERING)) {
    vec4 medium = mediaScattering(join.rank);
    scatters = !rlIsBlack(vec3(medium));
    // A diffusion profile stands for all light that has entered by a surface.
    if (medium.w == RL_PHASE_DIFFUSION && !isAtCamera && !isAtStart) return false;
  }

  if (gParams.exponent != RL_BDPT_ALONE) {
    float ofThere = leavesHere * (isFar ? 1.0f : cosThere * area);
    float beyond = 0.0f;
    if (isAtStart) {
      if (start.isFindable != 0u) beyond = bdptPower(ofThere / start.pdf);
    } else {
      beyond = bdptPower(rlSafeDivide(ofThere, light.density)) *
               (light.joins + min(bdptPower(backThere) * light.others, RL_BDPT_LARGEST));
    }
    float others = 0.0f;
    // No light's path crosses a medium that scatters.
    if (!isAtCamera && !scatters)
      others = eye.joins + min(bdptPower(backHere) * eye.others, RL_BDPT_LARGEST);
    value *= bdptWeight(leavesThere * cosHere * area, eye.density, others, beyond);
  }

  vec3 sigma = vec3(0.0f, 0.0f, 0.0f);
  if (isAtCamera) {
    sigma = surfaceSigma(light.s, light.sigma, -dirW);
    join.ray.origin = surfaceOffset(light.s.posW, light.s.nGeoW, light.s.posError, -dirW);
    join.ray.dir = here - join.ray.origin;
    join.ray.tMax = 1.0f;
  } else {
    sigma = surfaceSigma(eye.s, eye.sigma, dirW);
    join.ray.origin = surfaceOffset(eye.s.posW, eye.s.nGeoW, eye.s.posError, dirW);
    vec3 target = there;
    if (!isAtStart)
      target = surfaceSegmentEnd(there, light.s.nGeoW, light.s.posError, eye.s.posError, -dirW);
    if (isAtStart && start.kind == RL_LIGHT_AREA)
      target = surfaceSegmentEnd(there, start.normal, start.posError, eye.s.posError, -dirW);
    join.ray.dir = target - join.ray.origin;
    join.ray.tMax = 1.0f;
    if (isFar) {
      join.ray.dir = dirW;
      join.ray.tMax = 3.0e38f;
    }
  }
  join.ray.tMin = 0.0f;
  if (RL_HAS(RL_FEATURE_VOLUME)) value *= exp(-sigma * distance);
  join.unshadowed = value;
  return true;
}
