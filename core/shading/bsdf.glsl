// The BSDF: lobes under one Fresnel layer, the same functions for every consumer.
//   bsdfEval        f |cos_i| of the non-delta lobes
//   bsdfPdf         solid-angle density of bsdfSample over the non-delta lobes
//   bsdfEvalAndPdf  both at once
//   bsdfSample        a direction with weight f |cos_i| / pdf
// Directions are in world space and point away from the surface; nGeo lies on the side of wo.
// The layering is that of the glTF 2.0 specification, appendix B, with two exceptions: the share
// that the specular layer leaves to the Lambert base (bsdfBaseShare), and the optional compensation
// of multiple scattering (core/shading/bsdf/multiscatter.glsl), whose lobe is sampled by the cosine
// together with Lambert's. core/shading/bsdf/inconsistent_normal.glsl handles shading normals that
// differ from the face normal.

RL_FN bool bsdfIsBlack(RL_IN(Bsdf) b) { return b.lobes == 0u; }

// Probabilities of drawing the specular and the transmission lobe; the rest goes to the cosine. The
// probabilities depend on wo alone, so that the density of all lobes together is known.
RL_FN vec2 bsdfLobeProbabilities(RL_IN(Bsdf) b, float cosO) {
  if (!RL_HAS(RL_FEATURE_GLOSSY) || (b.lobes & RL_LOBE_ANY_GLOSSY) == 0u) return vec2(0.0f, 0.0f);
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
  float transmitted = 0.0f;
  if (RL_HAS(RL_FEATURE_TRANSMISSION) && (b.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u) {
    transmitted = rlLuminance(b.transmission) * through;
  }
  // Give every rough lobe a minimum probability, even if Fresnel at wo leaves it nothing:
  // microfacets turned towards wo still let light through. Delta lobes have no such facets and keep
  // exactly their share: clear smooth glass before uniform light has no noise.
  float least = 0.1f * (specular + diffuse + transmitted);
  if ((b.lobes & RL_LOBE_SPECULAR) != 0u) specular = max(specular, least);
  if (hasDiffuse) diffuse = max(diffuse, least);
  if ((b.lobes & RL_LOBE_TRANSMISSION) != 0u) transmitted = max(transmitted, least);
  float total = specular + diffuse + transmitted;
  if (!(total > 0.0f)) return vec2(1.0f, 0.0f);
  return vec2(specular / total, transmitted / total);
}

// Share of light that passes the specular layer to the Lambert base and out again. Light enters as
// 1 - F(o) and leaves, by reciprocity, as 1 - F(i). The product is divided by the mean of 1 - F(i),
// so that a white base returns all light that enters (Ashikhmin & Shirley 2000; Kelemen &
// Szirmay-Kalos 2001). The factor 1 - F(h) of glTF's appendix B creates energy: a white base under
// a layer of ior 1.5 would reflect 1.22 of the light at 80 degrees.
RL_FN float bsdfBaseShare(RL_IN(Bsdf) b, float cosO, float cosI) {
  float enters = 1.0f - min(rlMax3(fresnelOfBsdf(b, cosO)), 1.0f);
  float leaves = 1.0f - min(rlMax3(fresnelOfBsdf(b, cosI)), 1.0f);
  // The cosine-weighted mean of Schlick's weight is 1/21; the dielectric curve's is at least 0.
  float mean = rlMax3(b.f0);
  if ((b.lobes & RL_LOBE_ANY_TRANSMISSION) == 0u) mean += (b.f90 - mean) * (1.0f / 21.0f);
  return enters * leaves * rlSafeDivide(1.0f, 1.0f - mean);
}

// Share of Lambert's light that passes the surface on its way out, at the exit of a diffusion
// profile (core/transport/diffusion.glsl); 1 elsewhere. cosI: above 0.
RL_FN float bsdfExitShare(RL_IN(Bsdf) b, float cosI) {
  if (!RL_HAS(RL_FEATURE_SCATTERING) || (b.lobes & RL_LOBE_EXIT) == 0u) return 1.0f;
  return 1.0f - fresnelDielectric(cosI, b.eta);
}

// Returns whether a part of the BSDF is sampled by the cosine.
RL_FN bool bsdfHasCosineLobe(RL_IN(Bsdf) b) {
  return (b.lobes & RL_LOBE_DIFFUSE) != 0u || multiscatterApplies(b);
}

// f |cos_i| of the lobes towards wiL; withCosine: includes the part that is sampled by the cosine.
RL_FN vec3 bsdfEvalLocal(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, bool withCosine) {
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return b.diffuse * lambertEval(wiL);
  if (wiL.z > 0.0f) {
    if (woL.z > 0.0f && (b.lobes & RL_LOBE_ANY_GLOSSY) != 0u) {
      vec3 hL = normalize(woL + wiL);
      vec3 fresnel = fresnelOfBsdf(b, clamp(dot(woL, hL), 0.0f, 1.0f));
      if ((b.lobes & RL_LOBE_SPECULAR) != 0u)
        f += fresnel * ggxReflectionEval(woL, wiL, hL, b.alpha);
      if (!withCosine) return f;
      if (multiscatterApplies(b)) return f + multiscatterEval(b, woL.z, wiL.z);
      f += b.diffuse * (lambertEval(wiL) * bsdfBaseShare(b, woL.z, wiL.z));
    } else if (withCosine) {
      f += b.diffuse * (lambertEval(wiL) * bsdfExitShare(b, wiL.z));
    }
  } else if (RL_HAS(RL_FEATURE_TRANSMISSION) && (b.lobes & RL_LOBE_TRANSMISSION) != 0u &&
             woL.z > 0.0f && wiL.z < 0.0f) {
    if ((b.lobes & RL_LOBE_THIN) != 0u) {
      // A thin sheet sends the mirrored reflection lobe to the other side.
      vec3 wiUp = vec3(wiL.x, wiL.y, -wiL.z);
      vec3 hL = normalize(woL + wiUp);
      float through = 1.0f - min(rlMax3(fresnelOfBsdf(b, clamp(dot(woL, hL), 0.0f, 1.0f))), 1.0f);
      f += b.transmission * (through * ggxReflectionEval(woL, wiUp, hL, b.alpha));
    } else {
      vec3 hL = transmissionHalfVector(woL, wiL, b.eta);
      float through = 1.0f - min(rlMax3(fresnelOfBsdf(b, clamp(dot(woL, hL), 0.0f, 1.0f))), 1.0f);
      f += b.transmission * (through * transmissionEval(woL, wiL, hL, b.alpha, b.eta));
    }
  }
  return f;
}

RL_FN float bsdfPdfLocal(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, bool withCosine) {
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return lambertPdf(wiL);
  vec2 p = bsdfLobeProbabilities(b, max(woL.z, 0.0f));
  float pdf = 0.0f;
  if (wiL.z > 0.0f) {
    if (withCosine && bsdfHasCosineLobe(b)) pdf += (1.0f - p.x - p.y) * lambertPdf(wiL);
    if ((b.lobes & RL_LOBE_SPECULAR) != 0u && woL.z > 0.0f) {
      vec3 hL = normalize(woL + wiL);
      pdf += p.x * ggxReflectionPdf(woL, hL, b.alpha);
    }
  } else if (RL_HAS(RL_FEATURE_TRANSMISSION) && (b.lobes & RL_LOBE_TRANSMISSION) != 0u &&
             woL.z > 0.0f && wiL.z < 0.0f) {
    if ((b.lobes & RL_LOBE_THIN) != 0u) {
      vec3 wiUp = vec3(wiL.x, wiL.y, -wiL.z);
      vec3 hL = normalize(woL + wiUp);
      pdf += p.y * ggxReflectionPdf(woL, hL, b.alpha);
    } else {
      vec3 hL = transmissionHalfVector(woL, wiL, b.eta);
      pdf += p.y * transmissionPdf(woL, wiL, hL, b.alpha, b.eta);
    }
  }
  return max(pdf, 0.0f);
}

// Sums BSDF and density over the directions that end in one world direction: asItIsL unchanged,
// mirroredL mirrored at the face. Both are local to the normal; (0, 0, 0): none. One call site for
// both.
RL_FN vec3 bsdfSumLocal(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) asItIsL, RL_IN(vec3) mirroredL,
                        RL_OUT(float) pdf) {
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  pdf = 0.0f;
  for (uint i = asItIsL.z != 0.0f ? 0u : 1u; i < (mirroredL.z != 0.0f ? 2u : 1u); i = i + 1u) {
    vec3 sourceL = i == 0u ? asItIsL : mirroredL;
    pdf += bsdfPdfLocal(b, woL, sourceL, i == 0u);
    f += bsdfEvalLocal(b, woL, sourceL, i == 0u);
  }
  return f;
}

// Returns whether a closure scatters (core/shading/closures), not the lobes of glTF.
RL_FN bool bsdfIsClosure(RL_IN(Bsdf) b) { return RL_HAS_CLOSURES && b.closure != RL_CLOSURE_GLTF; }

// The shading normal of a closure. Closures take no mirrored directions: light that a facet sends
// through the face is absorbed.
RL_FN vec3 bsdfClosureNormal(RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo) {
  float cosO = dot(nShade, wo);
  bool turns = RL_HAS(RL_FEATURE_SMOOTH_NORMALS | RL_FEATURE_NORMAL_MAPS) && cosO < 0.0f &&
               dot(nGeo, wo) > 0.0f;
  return turns ? nShade - wo * (2.0f * cosO) : nShade;
}

// Turns the frame of a normal about it, to the tangent and back.
RL_FN vec3 bsdfToTangent(RL_IN(Bsdf) b, RL_IN(vec3) v) {
  return vec3(b.tangent.x * v.x + b.tangent.y * v.y, b.tangent.x * v.y - b.tangent.y * v.x, v.z);
}
RL_FN vec3 bsdfFromTangent(RL_IN(Bsdf) b, RL_IN(vec3) v) {
  return vec3(b.tangent.x * v.x - b.tangent.y * v.y, b.tangent.x * v.y + b.tangent.y * v.x, v.z);
}

RL_FN vec3 bsdfClosureEvalAndPdf(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade,
                                 RL_IN(vec3) wo, RL_IN(vec3) wi, RL_OUT(float) pdf) {
  pdf = 0.0f;
  vec3 n = bsdfClosureNormal(nGeo, nShade, wo);
  vec3 woL = bsdfToTangent(b, frameToLocal(n, wo));
  vec3 wiL = bsdfToTangent(b, frameToLocal(n, wi));
  if (!(woL.z > 0.0f) || !sidesAgree(dot(nGeo, wi), wiL.z)) return vec3(0.0f, 0.0f, 0.0f);
  return closureEval(b, woL, wiL, pdf);
}

RL_FN BsdfSample bsdfClosureSample(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade,
                                   RL_IN(vec3) wo, float uLobe, RL_IN(vec2) u) {
  vec3 n = bsdfClosureNormal(nGeo, nShade, wo);
  vec3 woL = bsdfToTangent(b, frameToLocal(n, wo));
  if (!(woL.z > 0.0f)) return bsdfSampleNone();
  BsdfSample s = closureSample(b, woL, uLobe, u);
  vec3 wiL = s.wi;
  s.wi = frameToWorld(n, bsdfFromTangent(b, wiL));
  if (s.lobe == 0u || wiL.z == 0.0f || !sidesAgree(dot(nGeo, s.wi), wiL.z)) return bsdfSampleNone();
  if ((s.lobe & RL_LOBE_ANY_DELTA) != 0u) return s;
  float pdf;
  vec3 f = closureEval(b, woL, wiL, pdf);
  if (!(pdf > 0.0f)) return bsdfSampleNone();
  s.pdfSolidAngle = pdf;
  s.weight = f * (1.0f / pdf);
  return s;
}

RL_FN vec3 bsdfEvalAndPdfOfOne(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                               RL_IN(vec3) wi, RL_OUT(float) pdf) {
  if (bsdfIsClosure(b)) return bsdfClosureEvalAndPdf(b, nGeo, nShade, wo, wi, pdf);
  if (!RL_HAS(RL_FEATURE_GLOSSY)) {
    pdf = 0.0f;
    if (!(dot(nGeo, wi) > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
    pdf = max(dot(nShade, wi), 0.0f) * RL_INV_PI;
    return b.diffuse * pdf;
  }
  vec3 n = consistentNormal(b, nGeo, nShade, wo, dot(nShade, wo));
  vec3 woL = frameToLocal(n, wo);
  vec3 wiL = frameToLocal(n, wi);
  vec3 mirroredL = consistentNormalMirror(b, nGeo, n, wi, wiL);
  if (!sidesAgree(dot(nGeo, wi), wiL.z)) wiL = vec3(0.0f, 0.0f, 0.0f);
  return bsdfSumLocal(b, woL, wiL, mirroredL, pdf);
}

#ifdef RL_KEEPS_MIXTURE
// Sums over the materials of a mixture, with one call site for all.
RL_FN vec3 bsdfEvalAndPdf(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                          RL_IN(vec3) wi, RL_OUT(float) pdf) {
  if (!RL_HAS_CLOSURE(RL_CLOSURE_MIXTURE)) return bsdfEvalAndPdfOfOne(b, nGeo, nShade, wo, wi, pdf);
  bool isMixture = mixtureIs(b);
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  pdf = 0.0f;
  for (uint i = 0u; i < (isMixture ? RL_MIXTURE_COUNT : 1u); i = i + 1u) {
    Bsdf part = b;
    float share = 1.0f;
    float pick = 1.0f;
    if (isMixture) {
      share = mixtureWord(b.p0, i);
      pick = mixtureWord(b.p3, i);
      if (!(share > 0.0f)) continue;
      part = mixtureMaterial(b, i);
    }
    float partPdf;
    f += bsdfEvalAndPdfOfOne(part, nGeo, nShade, wo, wi, partPdf) * share;
    pdf += pick * partPdf;
  }
  return f;
}
#else
RL_FN vec3 bsdfEvalAndPdf(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                          RL_IN(vec3) wi, RL_OUT(float) pdf) {
  return bsdfEvalAndPdfOfOne(b, nGeo, nShade, wo, wi, pdf);
}
#endif

RL_FN vec3 bsdfEval(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                    RL_IN(vec3) wi) {
  float pdf;
  return bsdfEvalAndPdf(b, nGeo, nShade, wo, wi, pdf);
}

RL_FN float bsdfPdf(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                    RL_IN(vec3) wi) {
  float pdf;
  bsdfEvalAndPdf(b, nGeo, nShade, wo, wi, pdf);
  return pdf;
}

RL_FN BsdfSample bsdfSampleOfOne(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade,
                                 RL_IN(vec3) wo, float uLobe, RL_IN(vec2) u) {
  if (bsdfIsClosure(b)) return bsdfClosureSample(b, nGeo, nShade, wo, uLobe, u);
  BsdfSample result = bsdfSampleNone();
  result.wi = nShade;
  // Lambert alone: the weight is exactly the albedo, with the same bits in kernels with and without
  // glossy lobes.
  if (!RL_HAS(RL_FEATURE_GLOSSY) || (b.lobes & RL_LOBE_ANY_GLOSSY) == 0u) {
    vec3 wiL = lambertDraw(u);
    vec3 wi = frameToWorld(nShade, wiL);
    if (!(wiL.z > 0.0f) || !(dot(nGeo, wi) > 0.0f)) return result;
    result.wi = wi;
    result.pdfSolidAngle = lambertPdf(wiL);
    result.weight = b.diffuse * bsdfExitShare(b, wiL.z);
    result.lobe = RL_LOBE_DIFFUSE;
    return result;
  }
  vec3 n = consistentNormal(b, nGeo, nShade, wo, dot(nShade, wo));
  vec3 woL = frameToLocal(n, wo);
  vec2 p = bsdfLobeProbabilities(b, max(woL.z, 0.0f));
  vec3 wiL = vec3(0.0f, 0.0f, 1.0f);
  uint lobe = RL_LOBE_DIFFUSE;
  bool byCosine = false;
  if (uLobe < p.x) {
    if (!(woL.z > 0.0f)) return result;
    if ((b.lobes & RL_LOBE_SPECULAR_DELTA) != 0u) {
      lobe = RL_LOBE_SPECULAR_DELTA;
      wiL = vec3(-woL.x, -woL.y, woL.z);
    } else {
      lobe = RL_LOBE_SPECULAR;
      vec3 hL = ggxDrawVisibleNormal(woL, b.alpha, u);
      wiL = hL * (2.0f * dot(woL, hL)) - woL;
      if (!(wiL.z > 0.0f)) return result;
    }
  } else if (RL_HAS(RL_FEATURE_TRANSMISSION) && uLobe < p.x + p.y) {
    if (!(woL.z > 0.0f)) return result;
    bool isDelta = (b.lobes & RL_LOBE_TRANSMISSION_DELTA) != 0u;
    lobe = isDelta ? RL_LOBE_TRANSMISSION_DELTA : RL_LOBE_TRANSMISSION;
    vec3 hL = vec3(0.0f, 0.0f, 1.0f);
    if (!isDelta) hL = ggxDrawVisibleNormal(woL, b.alpha, u);
    if ((b.lobes & RL_LOBE_THIN) != 0u) {
      wiL = hL * (2.0f * dot(woL, hL)) - woL;
      wiL.z = -wiL.z;
    } else if (!transmissionRefract(woL, hL, b.eta, wiL)) {
      return result;
    }
    if (!(wiL.z < 0.0f)) return result;
  } else {
    if (!bsdfHasCosineLobe(b)) return result;
    if ((b.lobes & RL_LOBE_DIFFUSE) == 0u) lobe = RL_LOBE_SPECULAR;
    byCosine = true;
    wiL = lambertDraw(u);
    if (!(wiL.z > 0.0f)) return result;
  }
  vec3 wi = frameToWorld(n, wiL);
  float side = dot(nGeo, wi);
  bool agrees = sidesAgree(side, wiL.z);
  vec3 asItIsL = wiL;
  vec3 mirroredL = wiL;
  if (agrees) {
    mirroredL = consistentNormalMirror(b, nGeo, n, wi, wiL);
  } else {
    if (byCosine || side == 0.0f || !inconsistentNormalCanTurn(b)) return result;
    // Mirror the drawn direction at the face. The result may also be drawn unmirrored.
    wi -= nGeo * (2.0f * side);
    asItIsL = frameToLocal(n, wi);
    if (!sidesAgree(-side, asItIsL.z)) asItIsL = vec3(0.0f, 0.0f, 0.0f);
  }
  result.wi = wi;
  if ((lobe & RL_LOBE_ANY_DELTA) != 0u) {
    vec3 fresnel = fresnelOfBsdf(b, woL.z);
    if (lobe == RL_LOBE_SPECULAR_DELTA) {
      result.pdfSolidAngle = p.x;
      result.weight = fresnel * (1.0f / p.x);
    } else {
      float scale = (b.lobes & RL_LOBE_THIN) != 0u ? 1.0f : 1.0f / (b.eta * b.eta);
      result.pdfSolidAngle = p.y;
      result.weight = b.transmission * ((1.0f - min(rlMax3(fresnel), 1.0f)) * scale / p.y);
    }
    result.lobe = lobe;
    return result;
  }
  float pdf;
  vec3 f = bsdfSumLocal(b, woL, asItIsL, mirroredL, pdf);
  if (!(pdf > 0.0f)) return result;
  result.pdfSolidAngle = pdf;
  result.weight = f * (1.0f / pdf);
  result.lobe = lobe;
  return result;
}

// uLobe chooses the lobe (of a mixture the material as well), u the direction. lobe 0: absorbed.
RL_FN BsdfSample bsdfSample(RL_IN(Bsdf) b, RL_IN(vec3) nGeo, RL_IN(vec3) nShade, RL_IN(vec3) wo,
                            float uLobe, RL_IN(vec2) u) {
#ifdef RL_KEEPS_MIXTURE
  Bsdf part = b;
  float ofLobe = uLobe;
  uint i = 0u;
  bool isMixture = RL_HAS_CLOSURE(RL_CLOSURE_MIXTURE) && mixtureIs(b);
  if (isMixture) {
    i = mixturePick(b, ofLobe);
    part = mixtureMaterial(b, i);
  }
  BsdfSample s = bsdfSampleOfOne(part, nGeo, nShade, wo, ofLobe, u);
  if (!isMixture || s.lobe == 0u) return s;
  if ((s.lobe & RL_LOBE_ANY_DELTA) != 0u) {
    float pick = mixtureWord(b.p3, i);
    s.pdfSolidAngle *= pick;
    s.weight *= mixtureWord(b.p0, i) / pick;
    return s;
  }
  float pdf;
  vec3 f = bsdfEvalAndPdf(b, nGeo, nShade, wo, s.wi, pdf);
  if (!(pdf > 0.0f)) return bsdfSampleNone();
  s.pdfSolidAngle = pdf;
  s.weight = f * (1.0f / pdf);
  return s;
#else
  return bsdfSampleOfOne(b, nGeo, nShade, wo, uLobe, u);
#endif
}

// Returns whether the BSDF is Lambert alone: the light it sends does not depend on the direction.
RL_FN bool bsdfIsLambert(RL_IN(Bsdf) b) {
  return !RL_HAS(RL_FEATURE_GLOSSY) || (b.lobes == RL_LOBE_DIFFUSE && !bsdfIsClosure(b));
}

// Returns whether paths that arrive from other directions can be reused here: false for mirrors,
// glass, and surfaces smoother than minAlpha.
RL_FN bool bsdfIsReusable(RL_IN(Bsdf) b, float minAlpha) {
  if (bsdfIsBlack(b)) return false;
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return true;
  if ((b.lobes & (RL_LOBE_ANY_DELTA | RL_LOBE_ANY_TRANSMISSION)) != 0u) return false;
  return (b.lobes & RL_LOBE_SPECULAR) == 0u || b.alpha >= minAlpha;
}

// Returns whether a surface shows sharp images alone: every lobe is smoother than `maxAlpha`.
RL_FN bool bsdfIsMirror(RL_IN(Bsdf) b, float maxAlpha) {
  if (bsdfIsBlack(b) || (b.lobes & RL_LOBE_DIFFUSE) != 0u) return false;
  return !bsdfIsReusable(b, maxAlpha);
}

// Returns whether light from behind the surface reaches the viewer.
RL_FN bool bsdfIsTwoSided(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_TRANSMISSION) &&
         (b.lobes & (RL_LOBE_ANY_TRANSMISSION | RL_LOBE_EXIT)) != 0u;
}

// Share of the light that is reflected, roughly: diffuse and specular at normal incidence.
RL_FN vec3 bsdfReflectance(RL_IN(Bsdf) b) {
  vec3 reflectance = b.diffuse;
  if (RL_HAS(RL_FEATURE_GLOSSY)) reflectance += b.f0;
  return reflectance;
}

// Approximate albedo: reflectance plus transmission.
RL_FN vec3 bsdfAlbedo(RL_IN(Bsdf) b) {
  vec3 albedo = bsdfReflectance(b);
  if (RL_HAS(RL_FEATURE_GLOSSY)) albedo += b.transmission;
  return albedo;
}

// Approximate share of the light sent to the viewer that changes when the view turns by `angle`
// radians: angle over the lobe's width, times the share of the albedo that is not Lambert's.
RL_FN float bsdfLobeRotation(RL_IN(Bsdf) b, float angle) {
  if (!RL_HAS(RL_FEATURE_GLOSSY) && !RL_HAS(RL_FEATURE_TRANSMISSION)) return 0.0f;
  float all = rlLuminance(bsdfAlbedo(b));
  float glossy = max(all - rlLuminance(b.diffuse), 0.0f);
  return rlSafeDivide(glossy, all) * angle / max(b.alpha, RL_ALPHA_FLOOR);
}
