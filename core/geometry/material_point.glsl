// Parameters of a material at a point.

RL_FN vec2 surfaceUv(RL_IN(Geometry) geometry, RL_IN(uvec3) corners, RL_IN(vec2) bary, uint uvSet) {
  if (RL_HAS_SHAPES && geometry.shape != RL_SHAPE_TRIANGLES) return bary;
  uint offset = geometry.uvOffset[uvSet];
  if (offset == RL_INVALID) return vec2(0.0f, 0.0f);
  vec2 a = RL_SCENE_VEC2(gScene.uvs, offset + corners.x);
  vec2 b = RL_SCENE_VEC2(gScene.uvs, offset + corners.y);
  vec2 c = RL_SCENE_VEC2(gScene.uvs, offset + corners.z);
  return a + bary.x * (b - a) + bary.y * (c - a);
}

// The i-th parameter of a closure, in the order in which its file declares them: a colour, ...
RL_FN vec3 closureColor(RL_IN(MaterialPoint) at, uint i) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter + i);
  vec3 value = recordVec3(q);
  if (!RL_HAS(RL_FEATURE_TEXTURES) || q.w == RL_INVALID) return value;
  Texture tex = recordTexture(q.w & RL_PARAMETER_TEXTURE);
  return value * vec3(textureSample(tex, surfaceUv(at.geometry, at.corners, at.bary, tex.uvSet)));
}

// ... the index of a choice, ...
RL_FN uint closureChoice(RL_IN(MaterialPoint) at, uint i) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter + i);
  return q.x;
}

// ... or a number, whose texture has it in one channel.
RL_FN float closureNumber(RL_IN(MaterialPoint) at, uint i) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter + i);
  float value = uintBitsToFloat(q.x);
  if (!RL_HAS(RL_FEATURE_TEXTURES) || q.w == RL_INVALID) return value;
  Texture tex = recordTexture(q.w & RL_PARAMETER_TEXTURE);
  vec4 texel = textureSample(tex, surfaceUv(at.geometry, at.corners, at.bary, tex.uvSet));
  uint channel = q.w >> RL_PARAMETER_CHANNEL_SHIFT;
  float factor = channel == 0u   ? texel.x
                 : channel == 1u ? texel.y
                 : channel == 2u ? texel.z
                                 : texel.w;
  return value * factor;
}
