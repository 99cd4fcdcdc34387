// Layout of guides and motions in buffers (core/gbuffer/guide_data.h).

// First uvec4 of a guide: the normal, and the disparity, negative if a light is seen.
RL_FN vec4 guideSurface(RL_IN(Uvec4Ref) guides, uint pixelIndex) {
  return recordVec4(RL_EARLIER_UVEC4(guides, pixelIndex * RL_GUIDE_UVEC4S));
}
RL_FN bool guideIsLight(RL_IN(vec4) surface) { return !(surface.w > 0.0f); }
RL_FN Guide guideRead(RL_IN(Uvec4Ref) guides, uint pixelIndex) {
  vec4 surface = guideSurface(guides, pixelIndex);
  uvec4 q = RL_EARLIER_UVEC4(guides, pixelIndex * RL_GUIDE_UVEC4S + 1u);
  Guide g;
  g.nW = vec3(surface.x, surface.y, surface.z);
  g.disparity = abs(surface.w);
  g.slope = vec2(uintBitsToFloat(q.x), uintBitsToFloat(q.y));
  g.reflectance = unpackPositive3(q.z, q.w);
  g.isLight = guideIsLight(surface) ? 1u : 0u;
  return g;
}
RL_FN void guideWrite(RL_IN(Uvec4Ref) guides, uint pixelIndex, RL_IN(Guide) g) {
  float disparity = g.isLight != 0u ? -g.disparity : g.disparity;
  RL_WRITE_UVEC4(guides, pixelIndex * RL_GUIDE_UVEC4S,
                 recordUvec4(g.nW, floatBitsToUint(disparity)));
  uvec2 reflectance = packPositive3(g.reflectance);
  RL_WRITE_UVEC4(
      guides, pixelIndex * RL_GUIDE_UVEC4S + 1u,
      uvec4(floatBitsToUint(g.slope.x), floatBitsToUint(g.slope.y), reflectance.x, reflectance.y));
}

RL_FN Motion motionRead(RL_IN(Uvec4Ref) motions, uint pixelIndex) {
  vec4 q = recordVec4(RL_EARLIER_UVEC4(motions, pixelIndex));
  Motion m;
  m.film = vec2(q.x, q.y);
  m.disparity = q.z;
  m.turn = q.w;
  return m;
}
RL_FN void motionWrite(RL_IN(Uvec4Ref) motions, uint pixelIndex, RL_IN(Motion) m) {
  RL_WRITE_UVEC4(motions, pixelIndex,
                 uvec4(floatBitsToUint(m.film.x), floatBitsToUint(m.film.y),
                       floatBitsToUint(m.disparity), floatBitsToUint(m.turn)));
}
