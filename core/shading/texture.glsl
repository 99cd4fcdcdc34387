// Texture filtering: nearest or bilinear, repeat, clamp or mirror; sRGB decoded before filtering.

// Wraps texel index i, which textureSample() keeps at most one texel before the first and two
// periods behind it. Avoids division: integer vectors are divided lane by lane.
RL_FN int textureWrap(int i, uint n, uint mode) {
  int size = int(n);
  if (mode == RL_WRAP_CLAMP) return clamp(i, 0, size - 1);
  int period = mode == RL_WRAP_MIRROR ? 2 * size : size;
  int r = i;
  if (r < 0) r += period;
  if (r >= period) r -= period;
  if (r >= period) r -= period;
  if (r >= size) r = period - 1 - r;
  return r;
}

RL_FN vec4 textureTexel(RL_IN(Texture) tex, int x, int y) {
  uint index = tex.firstTexel + uint(textureWrap(y, tex.height, tex.wrapV)) * tex.width +
               uint(textureWrap(x, tex.width, tex.wrapU));
  uint texel = RL_SCENE_UINT(gScene.texels, index);
  uint r = texel & 255u;
  uint g = (texel >> 8u) & 255u;
  uint b = (texel >> 16u) & 255u;
  float a = float(texel >> 24u) * (1.0f / 255.0f);
  if ((tex.flags & RL_TEXTURE_SRGB) != 0u) {
    return vec4(RL_SCENE_FLOAT(gScene.srgbToLinear, r), RL_SCENE_FLOAT(gScene.srgbToLinear, g),
                RL_SCENE_FLOAT(gScene.srgbToLinear, b), a);
  }
  return vec4(float(r) * (1.0f / 255.0f), float(g) * (1.0f / 255.0f), float(b) * (1.0f / 255.0f),
              a);
}

// UV set coordinates in, RGBA out. Coordinates so large that they have no fraction give texel 0.
RL_FN_OUTLINE vec4 textureSample(RL_IN(Texture) tex, RL_IN(vec2) uvSet) {
  vec3 h = vec3(uvSet, 1.0f);
  vec2 uv = vec2(dot(tex.uvRow0, h), dot(tex.uvRow1, h));
  // Whole periods are dropped before the conversion to int: 2 covers the mirrored period.
  uv = uv - 2.0f * floor(uv * 0.5f);
  bool inRange = uv.x >= 0.0f && uv.x <= 2.0f && uv.y >= 0.0f && uv.y <= 2.0f;
  if (!inRange) uv = vec2(0.0f, 0.0f);
  if (tex.wrapU == RL_WRAP_CLAMP) uv.x = clamp(dot(tex.uvRow0, h), 0.0f, 1.0f);
  if (tex.wrapV == RL_WRAP_CLAMP) uv.y = clamp(dot(tex.uvRow1, h), 0.0f, 1.0f);
  vec2 texel = vec2(uv.x * float(tex.width), uv.y * float(tex.height));
  if ((tex.flags & RL_TEXTURE_NEAREST) != 0u) {
    return textureTexel(tex, int(floor(texel.x)), int(floor(texel.y)));
  }
  texel = texel - vec2(0.5f, 0.5f);
  vec2 base = floor(texel);
  vec2 f = texel - base;
  int x = int(base.x);
  int y = int(base.y);
  vec4 t00 = textureTexel(tex, x, y);
  vec4 t10 = textureTexel(tex, x + 1, y);
  vec4 t01 = textureTexel(tex, x, y + 1);
  vec4 t11 = textureTexel(tex, x + 1, y + 1);
  vec4 top = t00 + f.x * (t10 - t00);
  vec4 bottom = t01 + f.x * (t11 - t01);
  return top + f.y * (bottom - top);
}
