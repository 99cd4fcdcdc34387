// Dispersion (KHR_materials_dispersion): an index of refraction for each colour channel. A draw
// refracts by the index of one channel, of three alike, and carries the light of that channel
// alone; the density of a direction is the mean over the three. What the indices of bodies say
// about which body fills a place is that of the middle one.

RL_FN bool dispersionIs(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_DISPERSION) && (b.lobes & RL_LOBE_DISPERSION) != 0u;
}

RL_FN float dispersionWord(RL_IN(vec3) v, uint channel) {
  return channel == 0u ? v.x : channel == 1u ? v.y : v.z;
}
RL_FN vec3 dispersionOnly(RL_IN(vec3) v, uint channel) {
  return vec3(channel == 0u ? v.x : 0.0f, channel == 1u ? v.y : 0.0f, channel == 2u ? v.z : 0.0f);
}

// The surface as the light of one channel meets it.
RL_FN Bsdf dispersionChannel(RL_IN(Bsdf) b, uint channel) {
  Bsdf one = b;
  float side = channel == 0u ? -1.0f : channel == 1u ? 0.0f : 1.0f;
  float ratio = 1.0f + side * abs(b.p3.w);
  one.eta = b.p3.w < 0.0f ? b.eta / ratio : b.eta * ratio;
  one.lobes = b.lobes & ~RL_LOBE_DISPERSION;
  return one;
}
