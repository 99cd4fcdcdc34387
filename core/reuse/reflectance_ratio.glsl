// Reflectance here over that of a donor's surface, for carried estimates.
RL_FN vec3 pixelReflectanceRatio(RL_IN(GBufferTexel) donor, uint pixelIndex) {
  GBufferTexel here = visibleRead(gBuffers.visible, gFrame.camera, pixelIndex);
  return reuseReflectanceRatio(donor.reflectance, here.reflectance,
                               gParams.reuse.maxReflectanceRatio);
}
