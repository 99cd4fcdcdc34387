// How paths scatter: values and densities of a vertex in both directions. The value is always that
// of light on its way to the camera, f |cos| as `path` takes it, so that a light's path carries
// importance's asymmetry (Veach 1997, section 5.3): the cosines of shading normals, and the square
// of the index of refraction.

RL_FN float bdptPower(float ratio) {
  float x = gParams.exponent == RL_BDPT_BALANCE ? ratio : ratio * ratio;
  return min(x, RL_BDPT_LARGEST);
}

// The surface as it is seen from dirW (unit).
RL_FN Surface bdptSeenFrom(RL_IN(Surface) s, RL_IN(vec3) dirW) {
  Surface seen = s;
  seen.wo = dirW;
  if (dot(s.nGeoW, dirW) >= 0.0f || (s.bsdf.lobes & RL_LOBE_EXIT) != 0u) return seen;
  Hit hit = traceNoHit();
  hit.instance = s.id.instance;
  hit.primitive = s.id.primitive;
  hit.bary = s.id.bary;
  return surfaceLoadBetween(hit, -dirW, s.contrast);
}

// f |cos| of light that arrives from where the path goes and leaves to where it came from; of a
// light's path the other way round. forward: density of dirW from s.wo; backward: of s.wo from
// dirW; both per solid angle.
RL_FN_OUTLINE vec3 bdptEval(RL_IN(Surface) s, RL_IN(vec3) dirW, bool isOfLight,
                            RL_OUT(float) forward, RL_OUT(float) backward) {
  vec3 value = vec3(0.0f, 0.0f, 0.0f);
  forward = 0.0f;
  backward = 0.0f;
  for (uint i = 0u; i < 2u; i = i + 1u) {
    bool isBack = i == 1u;
    Surface seen = s;
    if (isBack) seen = bdptSeenFrom(s, dirW);
    vec3 wi = dirW;
    if (isBack) wi = s.wo;
    float pdf;
    vec3 f = bsdfEvalAndPdf(seen.bsdf, seen.nGeoW, seen.nShadeW, seen.wo, wi, pdf);
    if (isBack) {
      backward = pdf;
    } else {
      forward = pdf;
    }
    if (isBack == isOfLight) value = f;
  }
  return value;
}

// Number between 0 and 1 below which bsdfSample() draws, of glTF's lobes, in this order: the coat,
// the sheen, reflection, transmission.
RL_FN vec4 bdptLobeBounds(RL_IN(Surface) s, RL_IN(Bsdf) b) {
  vec3 n = consistentNormal(b, s.nGeoW, s.nShadeW, s.wo, dot(s.nShadeW, s.wo));
  vec3 woL = frameToLocal(n, s.wo);
  vec2 p = bsdfLobeProbabilities(b, max(woL.z, 0.0f));
  vec2 q = vec2(0.0f, 0.0f);
  if (RL_HAS(RL_FEATURE_CLEARCOAT | RL_FEATURE_SHEEN) && layersAre(b))
    q = bsdfLayerProbabilities(b, woL);
  float layers = q.x + q.y;
  float below = 1.0f - layers;
  return vec4(q.x, layers, layers + below * p.x, layers + below * (p.x + p.y));
}

// The number with which a draw in the other direction chooses the delta lobe that uLobe has chosen.
// seen: the surface from there; passes: the lobe transmits.
RL_FN float bdptLobeBack(RL_IN(Surface) s, RL_IN(Surface) seen, float uLobe, bool passes) {
  float own = uLobe;
  float base = 0.0f;
  float width = 1.0f;
  Bsdf here = s.bsdf;
  Bsdf there = seen.bsdf;
  if (RL_HAS_CLOSURE(RL_CLOSURE_MIXTURE) && mixtureIs(s.bsdf)) {
    uint part = mixturePick(s.bsdf, own);
    for (uint i = 0u; i < part; i = i + 1u) base += mixtureWord(s.bsdf.p3, i);
    width = mixtureWord(s.bsdf.p3, part);
    here = mixtureMaterial(s.bsdf, part);
    there = mixtureMaterial(seen.bsdf, part);
  }
  if (RL_HAS(RL_FEATURE_GLOSSY) && !bsdfIsClosure(here)) {
    bool isCoat = own < bdptLobeBounds(s, here).x;
    vec4 bounds = bdptLobeBounds(seen, there);
    own = passes ? 0.5f * (bounds.z + bounds.w) : 0.5f * (bounds.y + bounds.z);
    if (isCoat) own = 0.5f * bounds.x;
  }
  return base + width * own;
}

// Draws a direction with the lobe that uLobe chooses. Of a delta lobe, finds the same lobe in the
// other direction, too: `factor` is what a light's path is multiplied with, and backward 1 if a
// draw from there would lead here.
RL_FN BsdfSample bdptDraw(RL_IN(Surface) s, float uLobe, RL_IN(vec2) u, RL_OUT(float) backward,
                          RL_OUT(vec3) factor) {
  backward = 0.0f;
  factor = vec3(0.0f, 0.0f, 0.0f);
  Surface seen = s;
  float ofLobe = uLobe;
  BsdfSample draw = bsdfSampleNone();
  for (uint i = 0u; i < 2u; i = i + 1u) {
    BsdfSample drawn = bsdfSample(seen.bsdf, seen.nGeoW, seen.nShadeW, seen.wo, ofLobe, u);
    if (i == 0u) {
      draw = drawn;
      if ((draw.lobe & RL_LOBE_ANY_DELTA) == 0u) break;
      seen = bdptSeenFrom(s, draw.wi);
      ofLobe = bdptLobeBack(s, seen, uLobe, draw.lobe == RL_LOBE_TRANSMISSION_DELTA);
    } else {
      bool isSame = (drawn.lobe & RL_LOBE_ANY_DELTA) != 0u && dot(drawn.wi, s.wo) > RL_BDPT_SAME;
      if (!isSame) return draw;
      backward = 1.0f;
      // The factor of light on its way to the camera, over the probability of this draw.
      factor = drawn.weight * rlSafeDivide(drawn.pdfSolidAngle, draw.pdfSolidAngle);
      float cosThere = abs(dot(s.nGeoW, draw.wi));
      float cosHere = abs(dot(s.nGeoW, s.wo));
      float turn = rlSafeDivide(cosThere, cosHere);
      if (draw.lobe == RL_LOBE_TRANSMISSION_DELTA && (s.bsdf.lobes & RL_LOBE_THIN) == 0u) {
        // A cone of light is refracted to another one: the square of the index cancels.
        Bsdf b = seen.bsdf;
        if (dispersionIs(b)) b = dispersionChannel(b, min(uint(u.x * 3.0f), 2u));
        turn *=
            b.eta * b.eta * rlSafeDivide(abs(dot(s.nShadeW, s.wo)), abs(dot(s.nShadeW, draw.wi)));
      }
      factor *= turn;
    }
  }
  return draw;
}

// Draws the next ray of a path. Sets its densities and throughput; isAlive 0: absorbed.
RL_FN void bdptScatter(RL_INOUT(BdptPath) path, bool isOfLight) {
  float uLobe = rngDraw(path.rng, RL_DIM_BSDF_LOBE);
  vec2 u;
  u.x = rngDraw(path.rng, RL_DIM_BSDF_U);
  u.y = rngDraw(path.rng, RL_DIM_BSDF_V);
  float backward;
  vec3 factor;
  BsdfSample draw = bdptDraw(path.s, uLobe, u, backward, factor);
  if (draw.lobe == 0u) {
    path.isAlive = 0u;
    return;
  }
  bool isDelta = (draw.lobe & RL_LOBE_ANY_DELTA) != 0u;
  path.pdfRay = 1.0f;
  path.pastCosine = abs(dot(path.s.nGeoW, draw.wi));
  if (!isDelta) {
    float forward;
    factor = bdptEval(path.s, draw.wi, isOfLight, forward, backward);
    path.pdfRay = draw.pdfSolidAngle;
    float reached = abs(dot(path.s.nGeoW, path.s.wo));
    factor *= rlSafeDivide(path.pastCosine, reached * draw.pdfSolidAngle);
  }
  if (!isOfLight) factor = draw.weight;
  path.throughput *= factor;
  if (rlIsBlack(factor) || !(path.pastCosine > 0.0f)) {
    path.isAlive = 0u;
    return;
  }
  // Light's paths have no throughput of their own scale: what one vertex leaves decides.
  if (path.events >= gFrame.rouletteStart) {
    float survival = min(rlMax3(isOfLight ? factor : path.throughput), 0.95f);
    if (rngDraw(path.rng, RL_DIM_ROULETTE) < survival) {
      path.throughput *= 1.0f / survival;
    } else {
      path.isAlive = 0u;
    }
  }
  path.isParallel = 0u;
  path.pastDensity = path.density;
  path.pastJoins = isDelta ? 0.0f : 1.0f;
  path.pastOthers = (isDelta ? 0.0f : path.joins) + bdptPower(backward) * path.others;
  path.pastOthers = min(path.pastOthers, RL_BDPT_LARGEST);
  if (RL_HAS(RL_FEATURE_VOLUME) && dot(path.s.nGeoW, draw.wi) < 0.0f) {
    path.sigma = path.s.sigmaBeyond;
    path.media = path.behind;
  }
  path.ray.origin = surfaceOffset(path.s.posW, path.s.nGeoW, path.s.posError, draw.wi);
  path.ray.dir = draw.wi;
  path.ray.tMin = 0.0f;
  path.ray.tMax = 3.0e38f;
}

// Sets the densities of a vertex that the path's ray has met at a distance (m).
RL_FN void bdptArrive(RL_INOUT(BdptPath) path, float distance) {
  float area = path.isParallel != 0u ? 1.0f : 1.0f / (distance * distance);
  float reached = abs(dot(path.s.nGeoW, path.ray.dir));
  path.density = path.pdfRay * reached * area;
  path.others = path.pastOthers * bdptPower(rlSafeDivide(path.pastCosine * area, path.pastDensity));
  path.others = min(path.others, RL_BDPT_LARGEST);
  path.joins = path.pastJoins;
}
