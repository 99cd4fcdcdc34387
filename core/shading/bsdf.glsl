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

// f |cos_i| of the lobe that refracts, or passes a thin sheet.
RL_FN vec3 bsdfTransmissionEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  if ((b.lobes & RL_LOBE_THIN) != 0u) {
    // A thin sheet sends the mirrored reflection lobe to the other side.
    vec3 wiUp = vec3(wiL.x, wiL.y, -wiL.z);
    vec3 hL = normalize(woL + wiUp);
    float through = 1.0f - min(rlMax3(fresnelOfBsdf(b, clamp(dot(woL, hL), 0.0f, 1.0f))), 1.0f);
    return b.transmission * (through * baseReflectionEval(b, woL, wiUp, hL));
  }
  vec3 hL = transmissionHalfVector(woL, wiL, b.eta);
  float through = 1.0f - min(rlMax3(fresnelOfBsdf(b, clamp(dot(woL, hL), 0.0f, 1.0f))), 1.0f);
  return b.transmission * (through * baseTransmissionEval(b, woL, wiL, hL));
}

RL_FN float bsdfTransmissionPdf(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  if ((b.lobes & RL_LOBE_THIN) != 0u) {
    vec3 wiUp = vec3(wiL.x, wiL.y, -wiL.z);
    return baseReflectionPdf(b, woL, normalize(woL + wiUp));
  }
  return baseTransmissionPdf(b, woL, wiL, transmissionHalfVector(woL, wiL, b.eta));
}

// f |cos_i| of the lobes towards wiL; withCosine: includes the part that is sampled by the cosine.
RL_FN vec3 bsdfEvalLocal(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, bool withCosine) {
  vec3 f = vec3(0.0f, 0.0f, 0.0f);
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return b.diffuse * lambertEval(wiL);
  if (wiL.z > 0.0f) {
    if (woL.z > 0.0f && (b.lobes & RL_LOBE_ANY_GLOSSY) != 0u) {
      vec3 hL = normalize(woL + wiL);
      vec3 fresnel = fresnelOfBsdf(b, clamp(dot(woL, hL), 0.0f, 1.0f));
      if ((b.lobes & RL_LOBE_SPECULAR) != 0u) f += fresnel * baseReflectionEval(b, woL, wiL, hL);
      float passes = 1.0f;
      if (RL_HAS(RL_FEATURE_CLEARCOAT | RL_FEATURE_SHEEN)) {
        passes = layersPass(b, woL, wiL);
        f = f * passes + layersEval(b, woL, wiL, withCosine);
      }
      if (!withCosine) return f;
      if (multiscatterApplies(b)) return f + multiscatterEval(b, woL.z, wiL.z) * passes;
      float share = bsdfBaseShare(b, woL.z, wiL.z);
      if (RL_HAS(RL_FEATURE_CLEARCOAT | RL_FEATURE_SHEEN)) share *= bsdfLayersShare(b, woL, wiL);
      f += b.diffuse * (lambertEval(wiL) * share);
    } else if (withCosine) {
      f += b.diffuse * (lambertEval(wiL) * bsdfExitShare(b, wiL.z));
    }
  } else if (RL_HAS(RL_FEATURE_TRANSMISSION) && woL.z > 0.0f && wiL.z < 0.0f) {
    if ((b.lobes & RL_LOBE_TRANSMISSION) != 0u) {
      if (dispersionIs(b)) {
        for (uint i = 0u; i < 3u; i = i + 1u)
          f += dispersionOnly(bsdfTransmissionEval(dispersionChannel(b, i), woL, wiL), i);
      } else {
        f += bsdfTransmissionEval(b, woL, wiL);
      }
    }
    if (withCosine && diffuseTransmissionIs(b))
      f += vec3(b.p3) * (lambertEval(-wiL) * bsdfPassingShare(b, woL.z, -wiL.z));
    f = f * layersPass(b, woL, wiL);
  }
  return f;
}

RL_FN float bsdfPdfLocal(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, bool withCosine) {
  if (!RL_HAS(RL_FEATURE_GLOSSY)) return lambertPdf(wiL);
  vec2 p = bsdfLobeProbabilities(b, max(woL.z, 0.0f));
  float pdf = 0.0f;
  if (wiL.z > 0.0f) {
    if (withCosine && bsdfHasCosineLobe(b))
      pdf += (1.0f - p.x - p.y) * (1.0f - diffuseTransmissionShare(b)) * lambertPdf(wiL);
    if ((b.lobes & RL_LOBE_SPECULAR) != 0u && woL.z > 0.0f) {
      vec3 hL = normalize(woL + wiL);
      pdf += p.x * baseReflectionPdf(b, woL, hL);
    }
  } else if (RL_HAS(RL_FEATURE_TRANSMISSION) && woL.z > 0.0f && wiL.z < 0.0f) {
    if ((b.lobes & RL_LOBE_TRANSMISSION) != 0u) {
      if (dispersionIs(b)) {
        for (uint i = 0u; i < 3u; i = i + 1u)
          pdf += p.y * (1.0f / 3.0f) * bsdfTransmissionPdf(dispersionChannel(b, i), woL, wiL);
      } else {
        pdf += p.y * bsdfTransmissionPdf(b, woL, wiL);
      }
    }
    if (withCosine && diffuseTransmissionIs(b))
      pdf += (1.0f - p.x - p.y) * diffuseTransmissionShare(b) * lambertPdf(-wiL);
  }
  if (RL_HAS(RL_FEATURE_CLEARCOAT | RL_FEATURE_SHEEN) && layersAre(b)) {
    vec2 q = bsdfLayerProbabilities(b, woL);
    pdf = (1.0f - q.x - q.y) * pdf + layersPdf(b, woL, wiL, q, withCosine);
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
                                 RL_IN(vec3) wo, float uOfLobe, RL_IN(vec2) uOfDirection) {
  if (bsdfIsClosure(b)) return bsdfClosureSample(b, nGeo, nShade, wo, uOfLobe, uOfDirection);
  float uLobe = uOfLobe;
  vec2 u = uOfDirection;
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
  // Layers above are drawn first; the rest of uLobe chooses below.
  vec2 q = vec2(0.0f, 0.0f);
  float below = 1.0f;
  bool isCoat = false;
  bool isSheen = false;
  if (RL_HAS(RL_FEATURE_CLEARCOAT | RL_FEATURE_SHEEN) && layersAre(b)) {
    q = bsdfLayerProbabilities(b, woL);
    below = 1.0f - q.x - q.y;
    isCoat = uLobe < q.x;
    isSheen = !isCoat && uLobe < q.x + q.y;
    uLobe = min((uLobe - q.x - q.y) * rlSafeDivide(1.0f, below), 0.99999994f);
  }
  uint channel = 3u;  // of dispersion; 3: all
  float eta = b.eta;
  if (isCoat || isSheen) {
    if (!(woL.z > 0.0f)) return result;
    wiL = layersDraw(b, woL, isCoat, u);
    byCosine = isSheen;
    if (isCoat)
      lobe = (b.lobes & RL_LOBE_COAT_DELTA) != 0u ? RL_LOBE_SPECULAR_DELTA : RL_LOBE_SPECULAR;
    if (!(wiL.z > 0.0f)) return result;
  } else if (uLobe < p.x) {
    if (!(woL.z > 0.0f)) return result;
    if ((b.lobes & RL_LOBE_SPECULAR_DELTA) != 0u) {
      lobe = RL_LOBE_SPECULAR_DELTA;
      wiL = vec3(-woL.x, -woL.y, woL.z);
    } else {
      lobe = RL_LOBE_SPECULAR;
      vec3 hL = baseDraw(b, woL, u);
      wiL = hL * (2.0f * dot(woL, hL)) - woL;
      if (!(wiL.z > 0.0f)) return result;
    }
  } else if (RL_HAS(RL_FEATURE_TRANSMISSION) && uLobe < p.x + p.y) {
    if (!(woL.z > 0.0f)) return result;
    bool isDelta = (b.lobes & RL_LOBE_TRANSMISSION_DELTA) != 0u;
    lobe = isDelta ? RL_LOBE_TRANSMISSION_DELTA : RL_LOBE_TRANSMISSION;
    if (dispersionIs(b)) {
      channel = min(uint(u.x * 3.0f), 2u);
      u.x = min(u.x * 3.0f - float(channel), 0.99999994f);
      eta = dispersionChannel(b, channel).eta;
    }
    vec3 hL = vec3(0.0f, 0.0f, 1.0f);
    if (!isDelta) hL = baseDraw(b, woL, u);
    if ((b.lobes & RL_LOBE_THIN) != 0u) {
      wiL = hL * (2.0f * dot(woL, hL)) - woL;
      wiL.z = -wiL.z;
    } else if (!transmissionRefract(woL, hL, eta, wiL)) {
      return result;
    }
    if (!(wiL.z < 0.0f)) return result;
  } else {
    if (!bsdfHasCosineLobe(b)) return result;
    if ((b.lobes & RL_LOBE_DIFFUSE) == 0u) lobe = RL_LOBE_SPECULAR;
    byCosine = true;
    wiL = lambertDraw(u);
    if (!(wiL.z > 0.0f)) return result;
    if (diffuseTransmissionIs(b)) {
      // The place in the interval of the cosine says to which side.
      float inside = (uLobe - p.x - p.y) * rlSafeDivide(1.0f, 1.0f - p.x - p.y);
      if (inside < diffuseTransmissionShare(b)) {
        if (!(woL.z > 0.0f)) return result;
        wiL.z = -wiL.z;
      }
    }
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
    if (isCoat) {
      float reflects = clearcoatFresnel(b, dot(clearcoatNormal(b, woL), woL)) / q.x;
      result.pdfSolidAngle = q.x;
      result.weight = vec3(reflects, reflects, reflects);
    } else if (lobe == RL_LOBE_SPECULAR_DELTA) {
      result.pdfSolidAngle = p.x;
      result.weight = fresnel * (1.0f / p.x);
    } else {
      float scale = (b.lobes & RL_LOBE_THIN) != 0u ? 1.0f : 1.0f / (eta * eta);
      result.pdfSolidAngle = p.y;
      result.weight = b.transmission * ((1.0f - min(rlMax3(fresnel), 1.0f)) * scale / p.y);
      if (dispersionIs(b)) {
        fresnel = fresnelOfBsdf(dispersionChannel(b, channel), woL.z);
        result.weight = b.transmission * ((1.0f - min(rlMax3(fresnel), 1.0f)) * scale / p.y);
        result.pdfSolidAngle = p.y * (1.0f / 3.0f);
        result.weight = dispersionOnly(result.weight, channel) * 3.0f;
      }
    }
    if (RL_HAS(RL_FEATURE_CLEARCOAT | RL_FEATURE_SHEEN) && !isCoat) {
      result.pdfSolidAngle *= below;
      result.weight *= layersPass(b, woL, wiL) * rlSafeDivide(1.0f, below);
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
  if ((b.lobes & (RL_LOBE_ANY_DELTA | RL_LOBE_ANY_PASSING)) != 0u) return false;
  return (b.lobes & (RL_LOBE_SPECULAR | RL_LOBE_COAT)) == 0u || b.alpha >= minAlpha;
}

// Returns whether a surface shows sharp images alone: every lobe is smoother than `maxAlpha`.
RL_FN bool bsdfIsMirror(RL_IN(Bsdf) b, float maxAlpha) {
  if (bsdfIsBlack(b) || (b.lobes & RL_LOBE_DIFFUSE) != 0u) return false;
  if ((b.lobes & (RL_LOBE_SHEEN | RL_LOBE_DIFFUSE_TRANSMISSION)) != 0u) return false;
  bool isRoughBelow = (b.lobes & (RL_LOBE_SPECULAR | RL_LOBE_TRANSMISSION)) != 0u;
  if (clearcoatIs(b) && isRoughBelow && clearcoatAlphaBelow(b) >= maxAlpha) return false;
  return !bsdfIsReusable(b, maxAlpha);
}

// Returns whether light from behind the surface reaches the viewer.
RL_FN bool bsdfIsTwoSided(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_TRANSMISSION) && (b.lobes & (RL_LOBE_ANY_PASSING | RL_LOBE_EXIT)) != 0u;
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
  if (diffuseTransmissionIs(b)) albedo += vec3(b.p3);
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
