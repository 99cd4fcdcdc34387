// Path samples of methods that resample direct light alone (RL_DIRECT_ONLY). A light is named by
// its index in the light table, so that a reservoir takes 32 bytes with its state: PathSample::id
// holds the index as its instance, and the point on a triangle.

// Returns whether the light is a shape, whose part takes three bits of the first coordinate.
RL_FN bool directIsShape(RL_IN(PathSample) p) {
  // An empty reservoir names no light.
  return RL_HAS_SHAPES && pathLightKind(p) == RL_LIGHT_AREA && p.id.instance < gScene.lightCount &&
         lightIsShape(recordLight(p.id.instance));
}

// The two coordinates as words of a reservoir hold them. A light is evaluated at what they give.
RL_FN uvec2 directCoordinates(RL_IN(PathSample) p) {
  vec2 at = p.id.bary;
  if (pathLightKind(p) == RL_LIGHT_ENVIRONMENT) {
    vec2 octahedron = packOctahedron(p.wi);
    at = octahedron * 0.5f + vec2(0.5f, 0.5f);
  }
  at = clamp(at, vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
  uint y = uint(at.y * float(RL_DIRECT_GRID) + 0.5f);
  if (directIsShape(p))
    return uvec2(
        (p.id.primitive << RL_DIRECT_PART_SHIFT) | uint(at.x * float(RL_DIRECT_PART_GRID) + 0.5f),
        y);
  return uvec2(uint(at.x * float(RL_DIRECT_GRID) + 0.5f), y);
}
RL_FN void directSetCoordinates(RL_INOUT(PathSample) p, RL_IN(uvec2) at) {
  vec2 u = vec2(float(at.x), float(at.y)) * (1.0f / float(RL_DIRECT_GRID));
  p.id.bary = u;
  if (directIsShape(p)) {
    p.id.primitive = at.x >> RL_DIRECT_PART_SHIFT;
    p.id.bary.x = float(at.x & RL_DIRECT_PART_GRID) * (1.0f / float(RL_DIRECT_PART_GRID));
  }
  p.wi = vec3(0.0f, 0.0f, 1.0f);
  if (pathLightKind(p) == RL_LIGHT_ENVIRONMENT)
    p.wi = unpackOctahedron(u.x * 2.0f - 1.0f, u.y * 2.0f - 1.0f);
}

RL_FN PathSample pathOfLight(RL_IN(LightSample) light, uint film) {
  PathSample p;
  p.id = surfaceIdNone();
  p.id.instance = light.record;
  p.id.primitive = light.id.primitive;
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
  Light light = recordLight(p.id.instance);
  uint primitive = lightIsShape(light) ? p.id.primitive : light.primitive;
  LightSample end = lightPoint(p.id.instance, light, primitive, p.id.bary, p.wi);
  // Surfaces of bodies that touch lie within so much (core/transport/media.glsl).
  if (RL_HAS(RL_FEATURE_VOLUME) && gScene.bodiesMeet != 0u) end.posError *= 3.0f;
  return end;
}
