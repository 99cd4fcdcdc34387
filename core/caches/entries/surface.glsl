// Surface that an entry's reservoir is valid for: Lambert, whatever the material. Any target would
// do, as long as it is always the same.
RL_FN Surface anchorSurface(RL_IN(Anchor) anchor) {
  Surface s;
  s.posW = anchor.surface.posW;
  s.posError = anchor.posError;
  s.nGeoW = unpackNormal(anchor.surface.nGeoW);
  s.nShadeW = unpackNormal(anchor.surface.nShadeW);
  s.wo = s.nShadeW;
  s.emission = vec3(0.0f, 0.0f, 0.0f);
  s.sigmaAbsorption = vec3(0.0f, 0.0f, 0.0f);
  s.light = RL_INVALID;
  s.bsdf = bsdfNone();
  s.bsdf.diffuse = anchor.surface.reflectance;
  s.bsdf.lobes = RL_LOBE_DIFFUSE;
  return s;
}

RL_FN Anchor anchorOfSurface(RL_IN(Surface) s, uint slot) {
  Anchor a;
  a.surface.posW = s.posW;
  a.surface.isHit = 1u;
  a.surface.emits = 0u;
  a.surface.nGeoW = packNormal(s.nGeoW);
  a.surface.nShadeW = packNormal(s.nShadeW);
  // Round as buffers do: a target that changed by rounding would be another one.
  a.surface.reflectance = unpackColor(packColor(bsdfReflectance(s.bsdf)));
  a.posError = s.posError;
  a.begunBy = slot;
  return a;
}
