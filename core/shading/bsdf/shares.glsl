// How light divides between the lobes of glTF, and the probabilities of drawing them.

// Share of light that passes to the transmission lobe. With dispersion each channel has its own:
// one may still refract where another reflects all.
RL_FN float bsdfRefractedShare(RL_IN(Bsdf) b, float cosO, float through) {
  if (!dispersionIs(b)) return through;
  float sum = 0.0f;
  for (uint i = 0u; i < 3u; i = i + 1u)
    sum += 1.0f - min(rlMax3(fresnelOfBsdf(dispersionChannel(b, i), cosO)), 1.0f);
  return sum * (1.0f / 3.0f);
}

// Weights of the specular lobe, of those that are drawn by the cosine, and of the transmission
// lobe.
RL_FN vec3 bsdfLobeWeights(RL_IN(Bsdf) b, float cosO) {
  vec3 f = fresnelOfBsdf(b, cosO);
  float through = 1.0f - min(rlMax3(f), 1.0f);
  bool hasSpecular = (b.lobes & (RL_LOBE_SPECULAR | RL_LOBE_SPECULAR_DELTA)) != 0u;
  bool hasDiffuse = (b.lobes & RL_LOBE_DIFFUSE) != 0u;
  float specular = hasSpecular ? rlLuminance(f) : 0.0f;
  float diffuse = hasDiffuse ? rlLuminance(b.diffuse) * through : 0.0f;
  if (multiscatterApplies(b)) {
    vec2 shares = multiscatterLuminances(b, cosO);
    specular = shares.x;
    diffuse = shares.y;
  }
  if (diffuseTransmissionIs(b)) {
    diffuse += rlLuminance(vec3(b.p3)) * through;
    hasDiffuse = true;
  }
  float transmitted = 0.0f;
  if (RL_HAS(RL_FEATURE_TRANSMISSION) && (b.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u) {
    transmitted = rlLuminance(b.transmission) * bsdfRefractedShare(b, cosO, through);
  }
  // Give every rough lobe a minimum probability, even if Fresnel at wo leaves it nothing:
  // microfacets turned towards wo still let light through. Delta lobes have no such facets and keep
  // exactly their share: clear smooth glass before uniform light has no noise.
  float least = 0.1f * (specular + diffuse + transmitted);
  if ((b.lobes & RL_LOBE_SPECULAR) != 0u) specular = max(specular, least);
  if (hasDiffuse) diffuse = max(diffuse, least);
  if ((b.lobes & RL_LOBE_TRANSMISSION) != 0u) transmitted = max(transmitted, least);
  return vec3(specular, diffuse, transmitted);
}

// Probabilities of drawing the specular and the transmission lobe; the rest goes to the cosine. The
// probabilities depend on wo alone, so that the density of all lobes together is known. Those of
// the layers above come before them (core/shading/bsdf/layers.glsl).
RL_FN vec2 bsdfLobeProbabilities(RL_IN(Bsdf) b, float cosO) {
  if (!RL_HAS(RL_FEATURE_GLOSSY) || (b.lobes & RL_LOBE_ANY_GLOSSY) == 0u) return vec2(0.0f, 0.0f);
  vec3 weights = bsdfLobeWeights(b, cosO);
  float total = weights.x + weights.y + weights.z;
  if (!(total > 0.0f)) return vec2(1.0f, 0.0f);
  return vec2(weights.x / total, weights.z / total);
}

// Cosine-weighted mean of the Fresnel term.
RL_FN float bsdfBaseMean(RL_IN(Bsdf) b) {
  // The cosine-weighted mean of Schlick's weight is 1/21; the dielectric curve's is at least 0.
  float mean = rlMax3(b.f0);
  if ((b.lobes & RL_LOBE_ANY_TRANSMISSION) == 0u) mean += (b.f90 - mean) * (1.0f / 21.0f);
  return mean;
}

// Share of light that passes the specular layer to the Lambert base and out again. Light enters as
// 1 - F(o) and leaves, by reciprocity, as 1 - F(i). The product is divided by the mean of 1 - F(i),
// so that a white base returns all light that enters (Ashikhmin & Shirley 2000; Kelemen &
// Szirmay-Kalos 2001). The factor 1 - F(h) of glTF's appendix B creates energy: a white base under
// a layer of ior 1.5 would reflect 1.22 of the light at 80 degrees.
// The mean of a film's reflectance is unknown: below one, the smaller of both takes the place of
// the product.
RL_FN float bsdfBaseShare(RL_IN(Bsdf) b, float cosO, float cosI) {
  float enters = 1.0f - min(rlMax3(fresnelOfBsdf(b, cosO)), 1.0f);
  float leaves = 1.0f - min(rlMax3(fresnelOfBsdf(b, cosI)), 1.0f);
  if (thinFilmIs(b)) return min(enters, leaves);
  return enters * leaves * rlSafeDivide(1.0f, 1.0f - bsdfBaseMean(b));
}

// Share of light that passes the surface to the diffuse transmission beyond it. It leaves by the
// Fresnel term of the other side, which in a solid is another: so the share is reciprocal.
RL_FN float bsdfPassingShare(RL_IN(Bsdf) b, float cosO, float cosI) {
  Bsdf beyond = b;
  beyond.eta = (b.lobes & RL_LOBE_THIN) != 0u ? b.eta : 1.0f / b.eta;
  beyond.p3.w = -b.p3.w;
  float enters = 1.0f - min(rlMax3(fresnelOfBsdf(b, cosO)), 1.0f);
  float leaves = 1.0f - min(rlMax3(fresnelOfBsdf(beyond, cosI)), 1.0f);
  if (thinFilmIs(b)) return min(enters, leaves);
  return enters * leaves * rlSafeDivide(1.0f, 1.0f - bsdfBaseMean(b));
}

// Share of light that passes the layers to Lambert's reflection.
RL_FN float bsdfLayersShare(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  float share = sheenPasses(b, woL.z, wiL.z);
  if (thinFilmIs(b) || !clearcoatIs(b)) return share * clearcoatPasses(b, woL, wiL);
  float f0 = rlMax3(b.f0);
  return share * clearcoatPassesLambert(b, woL, wiL, 1.0f - bsdfBaseMean(b), max(b.f90 - f0, 0.0f));
}

// Probabilities of drawing the clearcoat and the sheen; the rest goes to the lobes below.
RL_FN vec2 bsdfLayerProbabilities(RL_IN(Bsdf) b, RL_IN(vec3) woL) {
  float cosO = max(woL.z, 0.0f);
  vec3 weights = bsdfLobeWeights(b, cosO);
  float below = weights.x + weights.y + weights.z;
  float sheen = 0.0f;
  float coat = 0.0f;
  if (sheenIs(b)) {
    float albedo = min(sheenAlbedo(cosO, b.p1.w), 1.0f);
    sheen = albedo * rlLuminance(vec3(b.p1));
    below *= 1.0f - albedo * rlMax3(vec3(b.p1));
    sheen = max(sheen, 0.1f * (sheen + below));
  }
  if (clearcoatIs(b)) {
    coat = clearcoatFresnel(b, max(dot(clearcoatNormal(b, woL), woL), 0.0f));
    sheen *= 1.0f - coat;
    below *= 1.0f - coat;
    if ((b.lobes & RL_LOBE_COAT) != 0u) coat = max(coat, 0.1f * (coat + sheen + below));
  }
  float total = coat + sheen + below;
  if (!(total > 0.0f)) return vec2(0.0f, 0.0f);
  return vec2(coat, sheen) * (1.0f / total);
}

// Share of Lambert's light that passes the surface on its way out, at the exit of a diffusion
// profile (core/transport/diffusion.glsl); 1 elsewhere. cosI: above 0.
RL_FN float bsdfExitShare(RL_IN(Bsdf) b, float cosI) {
  if (!RL_HAS(RL_FEATURE_SCATTERING) || (b.lobes & RL_LOBE_EXIT) == 0u) return 1.0f;
  return 1.0f - fresnelDielectric(cosI, b.eta);
}

// Returns whether a part of the BSDF is sampled by the cosine.
RL_FN bool bsdfHasCosineLobe(RL_IN(Bsdf) b) {
  return (b.lobes & RL_LOBE_DIFFUSE) != 0u || multiscatterApplies(b) || diffuseTransmissionIs(b);
}
