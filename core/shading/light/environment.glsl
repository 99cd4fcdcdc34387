// The environment: a latitude-longitude map, row 0 at +Y, its centre column towards -Z before
// rotation about +Y. Radiance is bilinear; the density is piecewise constant over texels.

// A kernel may be specialised for more than the scene has.
RL_FN bool environmentExists() {
  return RL_HAS(RL_FEATURE_ENVIRONMENT) && gScene.environmentWidth != 0u;
}

RL_FN vec3 environmentRotate(RL_IN(vec3) d, float angle) {
  float c = cos(angle);
  float s = sin(angle);
  return vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

// Texture coordinates in [0, 1) of a world direction.
RL_FN vec2 environmentUv(RL_IN(vec3) dirW) {
  vec3 d = environmentRotate(dirW, -gScene.environmentRotation);
  float u = atan(d.x, -d.z) * (0.5f * RL_INV_PI) + 0.5f;
  // Avoid acos(y): it loses half of its digits at the poles.
  float v = atan(sqrt(d.x * d.x + d.z * d.z), d.y) * RL_INV_PI;
  if (!(u < 1.0f)) u = 0.0f;
  return vec2(max(u, 0.0f), clamp(v, 0.0f, 0.99999994f));
}

RL_FN vec3 environmentTexel(int x, int y) {
  int w = int(gScene.environmentWidth);
  int h = int(gScene.environmentHeight);
  int xx = x < 0 ? x + w : (x >= w ? x - w : x);
  int yy = clamp(y, 0, h - 1);
  return RL_SCENE_VEC3(gScene.environment, uint(yy * w + xx));
}

RL_FN_OUTLINE vec3 environmentRadiance(RL_IN(vec3) dirW) {
  vec2 uv = environmentUv(dirW);
  float x = uv.x * float(gScene.environmentWidth) - 0.5f;
  float y = uv.y * float(gScene.environmentHeight) - 0.5f;
  float fx = floor(x);
  float fy = floor(y);
  int ix = int(fx);
  int iy = int(fy);
  float ax = x - fx;
  float ay = y - fy;
  vec3 top = environmentTexel(ix, iy) * (1.0f - ax) + environmentTexel(ix + 1, iy) * ax;
  vec3 bottom = environmentTexel(ix, iy + 1) * (1.0f - ax) + environmentTexel(ix + 1, iy + 1) * ax;
  return top * (1.0f - ay) + bottom * ay;
}

// pmf of a texel over its solid angle, taken as 2 pi^2 sin(theta) du dv at the direction itself.
RL_FN float environmentPdfOfTexel(uint texel, float sinTheta) {
  float texels = float(gScene.environmentWidth) * float(gScene.environmentHeight);
  if (!(sinTheta > 0.0f)) return 0.0f;
  return recordAlias(RL_SCENE_UVEC3(gScene.environmentAlias, texel)).pmf * texels /
         (2.0f * RL_PI * RL_PI * sinTheta);
}

RL_FN_OUTLINE float environmentPdf(RL_IN(vec3) dirW) {
  vec2 uv = environmentUv(dirW);
  uint w = gScene.environmentWidth;
  uint h = gScene.environmentHeight;
  uint x = min(uint(uv.x * float(w)), w - 1u);
  uint y = min(uint(uv.y * float(h)), h - 1u);
  return environmentPdfOfTexel(y * w + x, sqrt(dirW.x * dirW.x + dirW.z * dirW.z));
}

// bits: pick column and row of the alias table; their remainders pick the position inside the
// texel. aliasBits: decide between the column's own texel and its alias.
RL_FN_OUTLINE vec3 environmentDraw(RL_IN(uvec2) bits, uint aliasBits, RL_OUT(float) pdfSolidAngle) {
  uint w = gScene.environmentWidth;
  uint h = gScene.environmentHeight;
  uint i = rlMulHigh(bits.y, h) * w + rlMulHigh(bits.x, w);
  float restX = rngUnit(bits.x * w);
  float restY = rngUnit(bits.y * h);
  AliasEntry entry = recordAlias(RL_SCENE_UVEC3(gScene.environmentAlias, i));
  if (!(aliasBits < entry.keep)) i = entry.other;
  uint y = i / w;
  uint x = i - y * w;
  float phi = ((float(x) + restX) / float(w) - 0.5f) * (2.0f * RL_PI);
  float theta = (float(y) + restY) / float(h) * RL_PI;
  float sinTheta = sin(theta);
  vec3 d = vec3(sinTheta * sin(phi), cos(theta), -sinTheta * cos(phi));
  pdfSolidAngle = environmentPdfOfTexel(i, sinTheta);
  return environmentRotate(d, gScene.environmentRotation);
}

// The sky as a ray finds it that hits nothing. isInView: the ray begins at the camera.
RL_FN bool skyExists(bool isInView) {
  return environmentExists() || (isInView && gScene.hasBackground != 0u);
}
RL_FN vec3 skyRadiance(RL_IN(vec3) dirW, bool isInView) {
  return isInView && gScene.hasBackground != 0u ? gScene.background : environmentRadiance(dirW);
}
