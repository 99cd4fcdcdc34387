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
  p.kind = RL_PATH_DIRECT | (light.kind << RL_PATH_LIGHT_SHIFT);
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

// Words of a reservoir: light (28 bits) and its coordinates, W, confidence; film sample, F,
// residual.
RL_FN void directReservoirWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(PathReservoir) r) {
  uvec2 c = directCoordinates(r.path);
  uvec2 f = packShared3(r.state.F);
  uvec2 residual = packShared3(r.state.residual);
  RL_WRITE_UVEC4(words, at,
                 uvec4((r.path.id.instance & 0xfffffffu) | (c.x << 28u), (c.x >> 4u) | (c.y << 14u),
                       floatBitsToUint(r.state.W), floatBitsToUint(r.state.confidence)));
  RL_WRITE_UVEC4(words, at + 1u, uvec4(r.path.film, f.x, residual.x, f.y | (residual.y << 16u)));
}

RL_FN PathReservoir directReservoirRead(RL_IN(Uvec4Ref) words, uint at) {
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  PathReservoir r;
  r.state.F = unpackShared3(q1.y, q1.w & 0xffffu);
  r.state.W = uintBitsToFloat(q0.z);
  r.state.residual = unpackShared3(q1.z, q1.w >> 16u);
  r.state.confidence = uintBitsToFloat(q0.w);
  r.path.id = surfaceIdNone();
  r.path.id.instance = q0.x & 0xfffffffu;
  r.path.kind = RL_PATH_DIRECT;
  r.path.film = q1.x;
  r.path.radiance = vec3(0.0f, 0.0f, 0.0f);
  r.path.geometry = 0.0f;
  r.path.pdfLight = 0.0f;
  r.path.base = 0u;
  r.path.key = 0u;
  // An empty reservoir names no light.
  if (r.state.W > 0.0f) r.path.kind |= recordLight(r.path.id.instance).kind << RL_PATH_LIGHT_SHIFT;
  directSetCoordinates(r.path, uvec2((q0.x >> 28u) | ((q0.y & 0x3fffu) << 4u), q0.y >> 14u));
  return r;
}

RL_FN ReservoirState directStateRead(RL_IN(Uvec4Ref) words, uint at) {
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  ReservoirState state;
  state.F = unpackShared3(q1.y, q1.w & 0xffffu);
  state.W = uintBitsToFloat(q0.z);
  state.residual = unpackShared3(q1.z, q1.w >> 16u);
  state.confidence = uintBitsToFloat(q0.w);
  return state;
}
