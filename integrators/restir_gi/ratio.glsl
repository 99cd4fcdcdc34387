// Reflectance here over that of a donor's surface, for carried estimates.
RL_FN vec3 giRatio(RL_IN(VisibleSurface) donor, uint slot) {
  VisibleSurface here = visibleRead(gBuffers.visible, gFrame.camera, slot);
  return reuseReflectanceRatio(donor.reflectance, here.reflectance, gParams.maxReflectanceRatio);
}
