// The lobes of glTF at a point: a material's values with its textures, and the BSDF that
// they stand for.

// One texture slot of a material at a hit, white where the slot is empty.
RL_FN_OUTLINE vec4 surfaceSlot(RL_IN(Material) material, uint slot, RL_IN(Geometry) geometry,
                               RL_IN(uvec3) corners, RL_IN(vec2) bary) {
  uint id = material.textures[slot];
  if (id == RL_INVALID) return vec4(1.0f, 1.0f, 1.0f, 1.0f);
  Texture tex = recordTexture(id);
  return textureSample(tex, surfaceUv(geometry, corners, bary, tex.uvSet));
}

// Multiplies a material's values by its textures and vertex colours.
RL_FN void materialTexture(RL_INOUT(Material) m, RL_IN(MaterialPoint) at) {
  if (RL_HAS(RL_FEATURE_TEXTURES | RL_FEATURE_EMISSIVE_TEXTURES)) {
    uint waiting = 0u;
    for (uint slot = 0u; slot < RL_TEX_COUNT; slot = slot + 1u) {
      if (slot != RL_TEX_NORMAL && m.textures[slot] != RL_INVALID) waiting = waiting | (1u << slot);
    }
    // Use one call site of texture filtering for all slots. Loop over used slots only: parallel
    // lanes pay for every iteration of any lane.
    while (waiting != 0u) {
      uint slot = uint(findLSB(waiting));
      waiting = waiting & (waiting - 1u);
      vec4 texel = surfaceSlot(m, slot, at.geometry, at.corners, at.bary);
      if (slot == RL_TEX_BASE_COLOR) m.baseColor *= vec3(texel);
      if (slot == RL_TEX_METALLIC_ROUGHNESS) {
        m.metallic *= texel.z;
        m.roughness *= texel.y;
      }
      if (slot == RL_TEX_EMISSIVE) m.emission *= vec3(texel);
      if (slot == RL_TEX_TRANSMISSION) m.transmission *= texel.x;
      if (slot == RL_TEX_SPECULAR) m.specular *= texel.w;
      if (slot == RL_TEX_SPECULAR_COLOR) m.specularColor *= vec3(texel);
    }
  }
  if (RL_HAS(RL_FEATURE_VERTEX_COLORS) && at.geometry.colorOffset != RL_INVALID) {
    vec4 a = recordVec4(RL_SCENE_UVEC4(gScene.colors, at.geometry.colorOffset + at.corners.x));
    vec4 b = recordVec4(RL_SCENE_UVEC4(gScene.colors, at.geometry.colorOffset + at.corners.y));
    vec4 c = recordVec4(RL_SCENE_UVEC4(gScene.colors, at.geometry.colorOffset + at.corners.z));
    m.baseColor *= vec3(a + at.bary.x * (b - a) + at.bary.y * (c - a));
  }
}

// The BSDF of textured values. contrast: index of refraction inside over that outside, where the
// outside is not air; 0: the material's own.
RL_FN Bsdf materialLobes(RL_IN(Material) m, bool isFront, float contrast) {
  Bsdf b = bsdfNone();
  if ((m.flags & (RL_MATERIAL_UNLIT | RL_MATERIAL_BLACK)) != 0u) return b;
  b.diffuse = m.baseColor;
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    float ior = m.ior;
    if (RL_HAS(RL_FEATURE_VOLUME) && contrast > 0.0f) ior = contrast;
    float r = (ior - 1.0f) / (ior + 1.0f);
    vec3 dielectricF0 = min(m.specularColor * (r * r), vec3(1.0f, 1.0f, 1.0f)) * m.specular;
    b.f0 = dielectricF0 + (m.baseColor - dielectricF0) * m.metallic;
    b.f90 = m.specular + (1.0f - m.specular) * m.metallic;
    b.alpha = m.roughness * m.roughness;
    b.diffuse = m.baseColor * ((1.0f - m.metallic) * (1.0f - m.transmission));
    bool isDelta = b.alpha < RL_ALPHA_FLOOR;
    if (b.f90 > 0.0f && !rlIsBlack(b.f0)) {
      b.lobes = isDelta ? RL_LOBE_SPECULAR_DELTA : RL_LOBE_SPECULAR;
    }
    // An index of 0 stands for full reflection: there is no direction to refract to.
    bool canTransmit = m.transmission > 0.0f && m.metallic < 1.0f && ior > 0.0f;
    if (RL_HAS(RL_FEATURE_TRANSMISSION) && canTransmit) {
      b.transmission = m.baseColor * ((1.0f - m.metallic) * m.transmission);
      bool isThin = (m.flags & RL_MATERIAL_THIN) != 0u;
      // No contrast of indices: nothing is reflected, bent or blurred, however rough the surface.
      bool isClear = abs(ior - 1.0f) < RL_CLEAR_CONTRAST;
      b.lobes |= isDelta || isClear ? RL_LOBE_TRANSMISSION_DELTA : RL_LOBE_TRANSMISSION;
      if (isThin || isClear) b.lobes |= RL_LOBE_THIN;
      b.eta = isFront || isThin ? ior : 1.0f / ior;
    }
    if (isDelta && (b.lobes & RL_LOBE_ANY_DELTA) != 0u) RL_HEALTH(RL_HEALTH_DELTA_LOBES);
  }
  if (!rlIsBlack(b.diffuse)) b.lobes |= RL_LOBE_DIFFUSE;
  return b;
}
