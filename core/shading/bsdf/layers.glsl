// The layers of glTF's extensions together: a clearcoat over a sheen over the lobes of
// core/shading/bsdf.glsl, and diffuse transmission beside Lambert's reflection.

RL_FN bool diffuseTransmissionIs(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_DIFFUSE_TRANSMISSION) && (b.lobes & RL_LOBE_DIFFUSE_TRANSMISSION) != 0u;
}

// Probability that a draw by the cosine goes to the other side. The compensation of multiple
// scattering keeps a tenth of the draws for this side.
RL_FN float diffuseTransmissionShare(RL_IN(Bsdf) b) {
  if (!diffuseTransmissionIs(b)) return 0.0f;
  float passes = rlLuminance(vec3(b.p3));
  float share = passes / (passes + rlLuminance(b.diffuse));
  return multiscatterApplies(b) ? min(share, 0.9f) : share;
}

// Returns whether a layer above the others reflects.
RL_FN bool layersAre(RL_IN(Bsdf) b) { return clearcoatIs(b) || sheenIs(b); }

// Share of light that passes the layers to a lobe that is not Lambert's reflection.
RL_FN float layersPass(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  return clearcoatPasses(b, woL, wiL) * sheenPasses(b, abs(woL.z), abs(wiL.z));
}

// f |cos_i| of the layers themselves; withCosine: includes the sheen, which is absorbed as Lambert
// is where it goes through the face. Both directions above.
RL_FN vec3 layersEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, bool withCosine) {
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  if (RL_HAS(RL_FEATURE_CLEARCOAT) && (b.lobes & RL_LOBE_COAT) != 0u) {
    float coat = clearcoatEval(b, woL, wiL);
    f = vec3(coat, coat, coat);
  }
  if (withCosine && sheenIs(b)) f += sheenEval(b, woL, wiL) * clearcoatPasses(b, woL, wiL);
  return f;
}

// Density of draws from the layers. q: probabilities of the coat and of the sheen.
RL_FN float layersPdf(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec2) q,
                      bool withCosine) {
  float pdf = 0.0f;
  if (!(woL.z > 0.0f) || !(wiL.z > 0.0f)) return pdf;
  if (RL_HAS(RL_FEATURE_CLEARCOAT) && (b.lobes & RL_LOBE_COAT) != 0u)
    pdf += q.x * clearcoatPdf(b, woL, wiL);
  if (withCosine && sheenIs(b)) pdf += q.y * sheenPdf();
  return pdf;
}

RL_FN vec3 layersDraw(RL_IN(Bsdf) b, RL_IN(vec3) woL, bool isCoat, RL_IN(vec2) u) {
  return isCoat ? clearcoatDraw(b, woL, u) : sheenDraw(u);
}
