// Reflectance here over that of a donor's surface: the scale of the donor's residual.
RL_FN vec3 pixelReflectanceRatio(RL_IN(GBufferTexel) donor, uint pixelIndex) {
  GBufferTexel here = gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex);
  return reuseReflectanceRatio(donor.reflectance, here.reflectance,
                               gParams.reuse.maxReflectanceRatio);
}
