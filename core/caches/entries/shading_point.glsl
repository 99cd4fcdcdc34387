// Layout of shading points (surface points that entries are valid at) in buffers.

RL_FN ShadingPoint shadingPointNone() {
  ShadingPoint a;
  a.surface.posW = vec3(0.0f, 0.0f, 0.0f);
  a.surface.isHit = 0u;
  a.surface.emits = 0u;
  a.surface.isMirror = 0u;
  a.surface.nGeoW = 0u;
  a.surface.nShadeW = 0u;
  a.surface.reflectance = vec3(0.0f, 0.0f, 0.0f);
  a.posError = 0.0f;
  a.sourcePixel = RL_INVALID;
  return a;
}

RL_FN ShadingPoint shadingPointRead(RL_IN(Uvec4Ref) words, uint entry) {
  uvec4 q0 = RL_EARLIER_UVEC4(words, entry * RL_SHADING_POINT_UVEC4S);
  uvec4 q1 = RL_EARLIER_UVEC4(words, entry * RL_SHADING_POINT_UVEC4S + 1u);
  ShadingPoint a;
  a.surface.posW = recordVec3(q0);
  a.surface.isHit = q1.z >> 30u;
  a.surface.emits = 0u;
  a.surface.isMirror = 0u;
  a.surface.nGeoW = q0.w;
  a.surface.nShadeW = q1.x;
  a.surface.reflectance = unpackColor(q1.z);
  a.posError = uintBitsToFloat(q1.y);
  a.sourcePixel = q1.w;
  return a;
}

RL_FN void shadingPointWrite(RL_IN(Uvec4Ref) words, uint entry, RL_IN(ShadingPoint) a) {
  RL_WRITE_UVEC4(words, entry * RL_SHADING_POINT_UVEC4S,
                 recordUvec4(a.surface.posW, a.surface.nGeoW));
  RL_WRITE_UVEC4(words, entry * RL_SHADING_POINT_UVEC4S + 1u,
                 uvec4(a.surface.nShadeW, floatBitsToUint(a.posError),
                       packColor(a.surface.reflectance) | (a.surface.isHit << 30u), a.sourcePixel));
}
