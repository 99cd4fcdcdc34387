// Names of surface points.

RL_FN SurfaceId surfaceIdNone() {
  SurfaceId id;
  id.instance = RL_INVALID;
  id.primitive = 0u;
  id.bary = vec2(0.0f, 0.0f);
  return id;
}
