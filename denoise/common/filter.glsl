// Radiance over reflectance, which changes slowly over a surface, and edge weights. Includers have
// gBuffers.guide.

RL_FN Filtered filterRead(RL_IN(Uvec4Ref) words, uint pixelIndex) {
  uvec4 q = RL_EARLIER_UVEC4(words, pixelIndex);
  Filtered f;
  f.light = recordVec3(q);
  f.reflectance = uintBitsToFloat(q.w);
  return f;
}
RL_FN void filterWrite(RL_IN(Uvec4Ref) words, uint pixelIndex, RL_IN(Filtered) f) {
  RL_WRITE_UVEC4(words, pixelIndex, recordUvec4(f.light, floatBitsToUint(f.reflectance)));
}

// Divides this frame's radiance by the reflectance. Values that are not finite are counted and
// treated as missing: neighbours ignore them, and the pixel shows its neighbours' mean.
RL_FN Filtered filterBegin(RL_IN(vec3) radiance, RL_IN(Guide) guide) {
  Filtered f;
  f.light = radiance / guide.reflectance;
  f.reflectance = rlLuminance(guide.reflectance);
  // Squares must be finite, too: the variance needs them.
  if (!rlIsFinite3(f.light * f.light)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    f.light = vec3(0.0f, 0.0f, 0.0f);
    f.reflectance = 0.0f;
  }
  return f;
}

// Falloff: 1 at 0, 0 from 1 on, smooth between. Unlike an exponential it ends.
RL_FN float filterFall(float x) {
  float rest = max(1.0f - x * x, 0.0f);
  return rest * rest;
}
RL_FN FilterSurface filterSurface(RL_IN(Guide) g, RL_IN(FilterEdges) edges) {
  FilterSurface s;
  s.nW = g.nW;
  s.disparity = g.disparity;
  s.slope = g.slope;
  // Allow a pixel's distance on the plane: guides hold points anywhere within pixels.
  float distance = edges.plane * g.disparity + abs(g.slope.x) + abs(g.slope.y);
  s.perPlane = rlSafeDivide(1.0f, distance);
  s.perNormal = 1.0f / edges.normal;
  return s;
}
// Weight of a pixel at an offset in pixels, by its guide's first uvec4: 0 beyond an edge, and for
// lights and background, which no filter reads.
RL_FN float filterEdge(RL_IN(FilterSurface) here, RL_IN(vec4) there, float dx, float dy) {
  if (guideIsLight(there)) return 0.0f;
  float onPlane = here.disparity + here.slope.x * dx + here.slope.y * dy;
  float cosine = here.nW.x * there.x + here.nW.y * there.y + here.nW.z * there.z;
  return filterFall((there.w - onPlane) * here.perPlane) *
         filterFall(max(1.0f - cosine, 0.0f) * here.perNormal);
}

// Weight of a pixel by the brightness around both: near 1 if noise alone would make as large a
// difference, and less the more standard deviations the difference is. Compares means instead of
// pixels: a weight that depends on a pixel's own noise loses energy, because it leaves out what is
// bright by chance. Symmetric in both pixels.
RL_FN float filterLikeness(RL_IN(LocalLuminance) here, RL_IN(LocalLuminance) there,
                           float squareDeviations) {
  float difference = here.luminance - there.luminance;
  float allowed = squareDeviations * (here.variance + there.variance);
  // Ignore differences within rounding.
  allowed += 1.0e-10f * (here.luminance * here.luminance + there.luminance * there.luminance);
  allowed = min(allowed, 1.0e38f);  // infinity over infinity would be NaN
  float share = rlSafeDivide(allowed, allowed + 0.5f * difference * difference);
  return allowed > 0.0f ? share * share : 1.0f;
}
