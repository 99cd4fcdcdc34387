// The two terms of direct light at a vertex of a path, each with its MIS weight: the power
// heuristic (Veach 1997, chapter 9).

// Returns the light that a ray of the walk found.
RL_FN vec3 lightFound(RL_IN(Walk) walk, RL_IN(vec3) radiance, float pdfLight) {
  float weight = pdfLight > 0.0f ? lightMisWeight(walk.pdfBsdf, pdfLight) : 1.0f;
  return walk.throughput * radiance * weight;
}

// Computes the light of a light sample at a vertex, before its shadow ray. Returns whether the
// vertex reflects any of it.
RL_FN bool lightSampled(RL_IN(Walk) walk, RL_IN(Surface) s, RL_IN(LightSample) light,
                        RL_IN(LightConnection) c, RL_OUT(vec3) unshadowed) {
  float pdf;
  vec3 f = bsdfEvalAndPdf(s.bsdf, s.nGeoW, s.nShadeW, s.wo, c.dirW, pdf);
  float weight = c.isDelta ? 1.0f : lightMisWeight(c.pdfSolidAngle, pdf);
  unshadowed = walk.throughput * f * c.emitted * (c.geometry * weight / light.pdf);
  if (RL_HAS(RL_FEATURE_VOLUME))
    unshadowed *= exp(-surfaceSigma(s, walk.sigma, c.dirW) * c.distance);
  return !rlIsBlack(f);
}
