// The colour C_f of a surface of material C_m and texture C_t with alpha a_t, before it is lit:
//   modulate  C_m C_t
//   replace   C_t
//   decal     (1 - a_t) C_m + a_t C_t
//   add       min(C_m + C_t, 1)
// C_m is the base colour times the colours of the vertices. Where there is no texture it is C_m.

RL_FN vec3 localCombine(RL_IN(vec3) material, RL_IN(vec4) texel) {
  vec3 colour = vec3(texel);
  if (gParams.combine == RL_LOCAL_REPLACE) return colour;
  if (gParams.combine == RL_LOCAL_DECAL) return material * (1.0f - texel.w) + colour * texel.w;
  if (gParams.combine == RL_LOCAL_ADD) return min(material + colour, vec3(1.0f, 1.0f, 1.0f));
  return material * colour;
}

// Puts the combined colour into a surface of glTF's material, whose texture is modulated by now.
// All albedos of its lobes are the base colour times a factor, plus what does not depend on it.
RL_FN void localRecolour(RL_INOUT(Surface) s) {
  if (!RL_HAS(RL_FEATURE_TEXTURES) || gParams.combine == RL_LOCAL_MODULATE) return;
  Instance inst = recordInstance(s.id.instance);
  Material m = recordMaterial(inst.material);
  if (m.textures[RL_TEX_BASE_COLOR] == RL_INVALID) return;
  if (RL_HAS_CLOSURES && m.closure != RL_CLOSURE_GLTF) return;
  if ((m.flags & RL_MATERIAL_BLACK) != 0u) return;
  Geometry geometry = recordGeometry(inst.geometry);
  MaterialPoint at = surfaceMaterialPoint(inst, geometry, s.id.instance, s.id.primitive, s.id.bary);
  vec4 texel = surfaceSlot(m, RL_TEX_BASE_COLOR, geometry, at.corners, at.bary);
  m.textures[RL_TEX_BASE_COLOR] = RL_INVALID;
  materialTexture(m, at);
  vec3 before = m.baseColor * vec3(texel);
  vec3 combined = localCombine(m.baseColor, texel);
  vec3 none = vec3(0.0f, 0.0f, 0.0f);
  if ((m.flags & RL_MATERIAL_UNLIT) != 0u) {
    s.emission = combined;
    return;
  }
  vec3 more = combined - before;
  float share = (1.0f - m.metallic) * (1.0f - m.transmission);
  if (RL_HAS(RL_FEATURE_DIFFUSE_TRANSMISSION) &&
      (m.flags & RL_MATERIAL_DIFFUSE_TRANSMISSION) != 0u) {
    at.firstParameter = m.firstParameter;
    share *= 1.0f - closureNumber(at, RL_LAYER_DIFFUSE_TRANSMISSION);
  }
  if (!RL_HAS(RL_FEATURE_GLOSSY)) share = 1.0f;
  s.bsdf.diffuse = max(s.bsdf.diffuse + more * share, none);
  uint lobes = s.bsdf.lobes & ~RL_LOBE_DIFFUSE;
  if (!rlIsBlack(s.bsdf.diffuse)) lobes = lobes | RL_LOBE_DIFFUSE;
  if (RL_HAS(RL_FEATURE_GLOSSY)) {
    s.bsdf.f0 = max(s.bsdf.f0 + more * m.metallic, none);
    if (m.metallic > 0.0f && (lobes & (RL_LOBE_SPECULAR | RL_LOBE_SPECULAR_DELTA)) == 0u &&
        !rlIsBlack(s.bsdf.f0))
      lobes = lobes | (s.bsdf.alpha < RL_ALPHA_FLOOR ? RL_LOBE_SPECULAR_DELTA : RL_LOBE_SPECULAR);
    if ((lobes & RL_LOBE_ANY_TRANSMISSION) != 0u)
      s.bsdf.transmission =
          max(s.bsdf.transmission + more * ((1.0f - m.metallic) * m.transmission), none);
  }
  s.bsdf.lobes = lobes;
}
