// Direct light of mirrors that the camera sees: the two terms of a vertex, each with its MIS
// weight.

// Emission that a ray from the camera or from a mirror found.
RL_FN vec3 lightFoundInView(RL_IN(Walk) walk, RL_IN(vec3) emission, float pdfLight) {
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  return walk.throughput * emission * weight;
}

// Light sample at a mirror, without visibility.
RL_FN vec3 lightSampleInView(RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(LightSample) light,
                             RL_IN(LightConnection) c) {
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  float weight = c.isDelta ? 1.0f : lightMisWeight(c.pdfSolidAngle, pdf);
  vec3 arriving = c.emitted * (c.geometry / light.pdf);
  if (RL_HAS(RL_FEATURE_VOLUME)) arriving *= exp(-surfaceSigma(s, walk.sigma, c.dirW) * c.distance);
  return walk.throughput * f * arriving * weight;
}
