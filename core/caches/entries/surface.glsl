// Surface that an entry's reservoir is valid for: Lambert, whatever the material. Any target would
// do, as long as it is always the same.
RL_FN Surface shadingPointSurface(RL_IN(ShadingPoint) shadingPoint) {
  Surface s = surfaceNone();
  s.posW = shadingPoint.surface.posW;
  s.posError = shadingPoint.posError;
  s.nGeoW = unpackNormal(shadingPoint.surface.nGeoW);
  s.nShadeW = unpackNormal(shadingPoint.surface.nShadeW);
  s.wo = s.nShadeW;
  s.bsdf.diffuse = shadingPoint.surface.reflectance;
  s.bsdf.lobes = RL_LOBE_DIFFUSE;
  return s;
}

RL_FN ShadingPoint shadingPointOfSurface(RL_IN(Surface) s, uint pixelIndex) {
  ShadingPoint a;
  a.surface.posW = s.posW;
  a.surface.isHit = 1u;
  a.surface.emits = 0u;
  a.surface.isMirror = 0u;
  a.surface.nGeoW = packNormal(s.nGeoW);
  a.surface.nShadeW = packNormal(s.nShadeW);
  // Round as buffers do: a target that changed by rounding would be another one.
  a.surface.reflectance = unpackColor(packColor(bsdfReflectance(s.bsdf)));
  a.posError = s.posError;
  a.sourcePixel = pixelIndex;
  return a;
}
