// Path samples of methods that resample direct light alone (RL_DIRECT_ONLY). A light is named by
// its index in the light table, so that a reservoir takes 32 bytes with its state: PathSample::id
// holds the index as its instance, and the point on a triangle.

// The two coordinates as words of a reservoir hold them. A light is evaluated at what they give.
RL_FN uvec2 directCoordinates(RL_IN(PathSample) p) {
  vec2 at = p.id.bary;
  if (pathLightKind(p) == RL_LIGHT_ENVIRONMENT) {
    vec2 octahedron = packOctahedron(p.wi);
    at = octahedron * 0.5f + vec2(0.5f, 0.5f);
  }
  at = clamp(at, vec2(0.0f, 0.0f), vec2(1.0f, 1.0f)) * float(RL_DIRECT_GRID);
  return uvec2(uint(at.x + 0.5f), uint(at.y + 0.5f));
}
RL_FN void directSetCoordinates(RL_INOUT(PathSample) p, RL_IN(uvec2) at) {
  vec2 u = vec2(float(at.x), float(at.y)) * (1.0f / float(RL_DIRECT_GRID));
  p.id.bary = u;
  p.wi = vec3(0.0f, 0.0f, 1.0f);
  if (pathLightKind(p) == RL_LIGHT_ENVIRONMENT)
    p.wi = unpackOctahedron(u.x * 2.0f - 1.0f, u.y * 2.0f - 1.0f);
}

RL_FN PathSample pathOfLight(RL_IN(LightSample) light, uint film) {
  PathSample p;
  p.id = surfaceIdNone();
  p.id.instance = light.record;
  p.id.bary = light.id.bary;
  p.kind = RL_PATH_DIRECT | (light.kind << RL_PATH_LIGHT_KIND_SHIFT);
  p.film = film;
  p.radiance = vec3(0.0f, 0.0f, 0.0f);
  p.geometry = 0.0f;
  p.wi = light.point;
  p.pdfLight = 0.0f;
  p.base = 0u;
  p.key = 0u;
  directSetCoordinates(p, directCoordinates(p));
  return p;
}

RL_FN LightSample pathEnd(RL_IN(PathSample) p) {
  LightSample end = lightPoint(p.id.instance, recordLight(p.id.instance), p.id.bary, p.wi);
  // Surfaces of bodies that touch lie within so much (core/transport/media.glsl).
  if (RL_HAS(RL_FEATURE_VOLUME) && gScene.bodiesMeet != 0u) end.posError *= 3.0f;
  return end;
}
