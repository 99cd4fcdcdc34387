// Sheen of cloth (KHR_materials_sheen): a layer of fibres with the Charlie distribution and the
// fitted shadowing of Estevez and Kulla ("Production Friendly Microfacet Sheen BRDF", 2017), over
// all but the clearcoat. The lobes below get the smaller of 1 - c E(o) and 1 - c E(i), as glTF's
// text says: c is the greatest channel of the colour, E the albedo of a white sheen, out of a
// table. E of a sheen with a roughness below 0.26 exceeds 1 at grazing angles. The lobe is divided
// by it there, which the text does not do, so that it makes no energy.

RL_FN bool sheenIs(RL_IN(Bsdf) b) {
  return RL_HAS(RL_FEATURE_SHEEN) && (b.lobes & RL_LOBE_SHEEN) != 0u;
}

RL_FN float sheenLambdaFit(float x, float smoothness) {
  float a = 21.5473f + (25.3245f - 21.5473f) * smoothness;
  float b = 3.82987f + (3.32435f - 3.82987f) * smoothness;
  float c = 0.19823f + (0.16801f - 0.19823f) * smoothness;
  float d = -1.97760f + (-1.27393f + 1.97760f) * smoothness;
  float e = -4.32054f + (-4.85967f + 4.32054f) * smoothness;
  return a / (1.0f + b * pow(x, c)) + d * x + e;
}

RL_FN float sheenLambda(float cosTheta, float alpha) {
  float smoothness = (1.0f - alpha) * (1.0f - alpha);
  if (cosTheta < 0.5f) return exp(sheenLambdaFit(cosTheta, smoothness));
  return exp(2.0f * sheenLambdaFit(0.5f, smoothness) -
             sheenLambdaFit(max(1.0f - cosTheta, 0.0f), smoothness));
}

// D / (4 cos_o (1 + Lambda(o) + Lambda(i))): a white sheen times |cos_i|, before its albedo is
// limited. Both directions above.
RL_FN float sheenFibres(RL_IN(vec3) woL, RL_IN(vec3) wiL, float alpha) {
  vec3 hL = normalize(woL + wiL);
  float sin2 = hL.x * hL.x + hL.y * hL.y;
  float invAlpha = 1.0f / alpha;
  float d = (2.0f + invAlpha) * (0.5f * RL_INV_PI) * pow(sin2, 0.5f * invAlpha);
  return d / (4.0f * woL.z * (1.0f + sheenLambda(woL.z, alpha) + sheenLambda(wiL.z, alpha)));
}

// E, bilinear in the square roots. A record holds the corners of its cell.
RL_FN float sheenAlbedo(float cosTheta, float alpha) {
  float cells = float(RL_SHEEN_CELLS);
  float x = sqrt(clamp(cosTheta, 0.0f, 1.0f)) * cells;
  float y = sqrt(clamp(alpha, 0.0f, 1.0f)) * cells;
  uint column = min(uint(x), RL_SHEEN_CELLS - 1u);
  uint row = min(uint(y), RL_SHEEN_CELLS - 1u);
  float tx = x - float(column);
  float ty = y - float(row);
  vec4 e = recordVec4(RL_SCENE_UVEC4(gScene.closureParameters, row * RL_SHEEN_CELLS + column));
  return (e.x * (1.0f - tx) + e.y * tx) * (1.0f - ty) + (e.z * (1.0f - tx) + e.w * tx) * ty;
}

// Share of light that passes the sheen to the lobes below, and out again.
RL_FN float sheenPasses(RL_IN(Bsdf) b, float cosO, float cosI) {
  if (!sheenIs(b)) return 1.0f;
  float most = max(sheenAlbedo(cosO, b.p1.w), sheenAlbedo(cosI, b.p1.w));
  return 1.0f - rlMax3(vec3(b.p1)) * min(most, 1.0f);
}

// f |cos_i|. Both directions above.
RL_FN vec3 sheenEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  float most = max(sheenAlbedo(woL.z, b.p1.w), sheenAlbedo(wiL.z, b.p1.w));
  return vec3(b.p1) * (sheenFibres(woL, wiL, b.p1.w) / max(most, 1.0f));
}

// Directions are drawn from the whole hemisphere alike: the lobe is wide, and does not fall with
// the cosine.
RL_FN float sheenPdf() { return 0.5f * RL_INV_PI; }
RL_FN vec3 sheenDraw(RL_IN(vec2) u) {
  vec2 cs = rlCosSin2Pi(u.y);
  float r = sqrt(max(1.0f - u.x * u.x, 0.0f));
  return vec3(r * cs.x, r * cs.y, u.x);
}
