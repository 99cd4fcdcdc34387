// The layers of glTF's extensions at a point: reads their parameters (RL_LAYER_*) and adds them to
// the lobes that materialLobes() has made.

// Anisotropy: stretches the facets of the base along a direction that the texture and the angle
// turn from the tangent.
RL_FN void surfaceStretch(RL_INOUT(Surface) s, RL_IN(MaterialPoint) at, RL_IN(Instance) inst,
                          RL_IN(TriangleW) t, RL_IN(vec3) normalW) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter + RL_LAYER_ANISOTROPY);
  float strength = uintBitsToFloat(q.x);
  vec2 turn = vec2(uintBitsToFloat(q.y), uintBitsToFloat(q.z));
  uint uvSet = 0u;
  if (RL_HAS(RL_FEATURE_TEXTURES) && q.w != RL_INVALID) {
    Texture tex = recordTexture(q.w & RL_PARAMETER_TEXTURE);
    uvSet = tex.uvSet;
    vec4 texel = textureSample(tex, surfaceUv(at.geometry, at.corners, at.bary, tex.uvSet));
    vec2 d = vec2(texel.x * 2.0f - 1.0f, texel.y * 2.0f - 1.0f);
    float length2 = dot(d, d);
    if (length2 > 0.0f) d = d * (1.0f / sqrt(length2));
    if (length2 > 0.0f) turn = vec2(turn.x * d.x - turn.y * d.y, turn.y * d.x + turn.x * d.y);
    strength *= texel.z;
  }
  uint stretched = RL_LOBE_SPECULAR | RL_LOBE_SPECULAR_DELTA | RL_LOBE_ANY_TRANSMISSION;
  if (!(strength > 0.0f) || (s.bsdf.lobes & stretched) == 0u) return;
  float handedness;
  vec3 tangentW = surfaceTangent(inst, at.geometry, at.corners, at.bary, t, uvSet, handedness);
  if (rlIsBlack(tangentW)) tangentW = vec3(normalW.z, 0.0f, -normalW.x);
  if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_FLIPPED) != 0u)
    handedness = -handedness;
  tangentW = tangentW - normalW * dot(normalW, tangentW);
  float length2 = dot(tangentW, tangentW);
  if (!(length2 > 0.0f)) return;
  tangentW = tangentW * (1.0f / sqrt(length2));
  vec3 axisW = tangentW * turn.x + cross(normalW, tangentW) * (handedness * turn.y);
  vec3 axisL = frameToLocal(s.nShadeW, axisW);
  length2 = axisL.x * axisL.x + axisL.y * axisL.y;
  if (!(length2 > 0.0f)) return;
  float alpha = s.bsdf.alpha;
  float along = alpha + (1.0f - alpha) * strength * strength;
  if (along < RL_ALPHA_FLOOR) return;
  s.bsdf.tangent = vec2(axisL.x, axisL.y) * (1.0f / sqrt(length2));
  s.bsdf.alpha = max(alpha, RL_ALPHA_FLOOR);
  s.bsdf.p2.x = along;
  s.bsdf.p2.y = s.bsdf.alpha;
  // Facets that are smooth across alone are no mirror.
  uint lobes = s.bsdf.lobes;
  if ((lobes & RL_LOBE_SPECULAR_DELTA) != 0u)
    lobes = (lobes & ~RL_LOBE_SPECULAR_DELTA) | RL_LOBE_SPECULAR;
  bool isClear = abs(s.bsdf.eta - 1.0f) < RL_CLEAR_CONTRAST;
  if ((lobes & RL_LOBE_TRANSMISSION_DELTA) != 0u && !isClear)
    lobes = (lobes & ~RL_LOBE_TRANSMISSION_DELTA) | RL_LOBE_TRANSMISSION;
  s.bsdf.lobes = lobes | RL_LOBE_ANISOTROPIC;
}

// normalW: interpolated, without a normal map.
RL_FN void surfaceCoat(RL_INOUT(Surface) s, RL_IN(Material) material, RL_IN(MaterialPoint) at,
                       RL_IN(Instance) inst, RL_IN(TriangleW) t, RL_IN(vec3) normalW) {
  float factor = closureNumber(at, RL_LAYER_CLEARCOAT);
  if (!(factor > 0.0f)) return;
  float roughness = closureNumber(at, RL_LAYER_CLEARCOAT_ROUGHNESS);
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter + RL_LAYER_CLEARCOAT_NORMAL);
  vec3 n = normalW;
  vec2 tilt = vec2(0.0f, 0.0f);
  if (RL_HAS(RL_FEATURE_NORMAL_MAPS) &&
      (q.w != RL_INVALID || material.textures[RL_TEX_NORMAL] != RL_INVALID)) {
    if (q.w != RL_INVALID) {
      Material ofCoat = material;
      ofCoat.textures[RL_TEX_NORMAL] = q.w & RL_PARAMETER_TEXTURE;
      ofCoat.normalScale = uintBitsToFloat(q.x);
      n = surfaceNormalMapped(inst, at.geometry, ofCoat, at.corners, at.bary, t, normalW);
    }
    if (s.isFront == 0u) n = -n;
    float side = dot(n, s.nGeoW);
    if (side <= 0.0f) n = normalize(n - s.nGeoW * (2.0f * side) + s.nGeoW * 1.0e-3f);
    // One behind the surface's normal is mirrored at it: its z is taken as positive.
    vec3 nL = frameToLocal(s.nShadeW, n);
    tilt = vec2(nL.x, nL.y);
  }
  float alpha = roughness * roughness;
  bool isSmooth = alpha < RL_ALPHA_FLOOR;
  s.bsdf.p0 = vec4(factor, max(alpha, RL_ALPHA_FLOOR), tilt.x, tilt.y);
  bool isSolid =
      (s.bsdf.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u && (material.flags & RL_MATERIAL_THIN) == 0u;
  if (isSolid && s.isFront == 0u) {
    s.bsdf.lobes = s.bsdf.lobes | RL_LOBE_COAT_BEYOND;
    return;
  }
  s.bsdf.p2.y = s.bsdf.alpha;
  bool isGlossyBelow =
      (s.bsdf.lobes & (RL_LOBE_SPECULAR | RL_LOBE_TRANSMISSION | RL_LOBE_ANY_DELTA)) != 0u;
  s.bsdf.alpha = isGlossyBelow ? min(s.bsdf.alpha, alpha) : alpha;
  s.bsdf.lobes = s.bsdf.lobes | (isSmooth ? RL_LOBE_COAT_DELTA : RL_LOBE_COAT);
  if (isSmooth) RL_HEALTH(RL_HEALTH_DELTA_LOBES);
}

RL_FN void surfaceFilm(RL_INOUT(Surface) s, RL_IN(MaterialPoint) at) {
  float factor = closureNumber(at, RL_LAYER_IRIDESCENCE);
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter + RL_LAYER_FILM);
  float thickness = uintBitsToFloat(q.y);
  if (RL_HAS(RL_FEATURE_TEXTURES) && q.w != RL_INVALID) {
    Texture tex = recordTexture(q.w & RL_PARAMETER_TEXTURE);
    vec4 texel = textureSample(tex, surfaceUv(at.geometry, at.corners, at.bary, tex.uvSet));
    thickness = uintBitsToFloat(q.x) + (thickness - uintBitsToFloat(q.x)) * texel.y;
  }
  float index = uintBitsToFloat(q.z);
  uint share = uint(clamp(factor, 0.0f, 1.0f) * 65535.0f + 0.5f);
  if (share == 0u || !(thickness > 0.0f) || abs(index - 1.0f) < RL_CLEAR_CONTRAST) return;
  s.bsdf.p2.z = thickness;
  s.bsdf.p2.w = index;
  uint lobes = s.bsdf.lobes | RL_LOBE_FILM | (share << RL_LOBE_FILM_SHIFT);
  // A film reflects even where the surface alone does not.
  if ((lobes & (RL_LOBE_SPECULAR | RL_LOBE_SPECULAR_DELTA)) == 0u) {
    bool isDelta = s.bsdf.alpha < RL_ALPHA_FLOOR;
    lobes = lobes | (isDelta ? RL_LOBE_SPECULAR_DELTA : RL_LOBE_SPECULAR);
  }
  s.bsdf.lobes = lobes;
}

RL_FN_OUTLINE void surfaceAddLayers(RL_INOUT(Surface) s, RL_IN(Material) material,
                                    RL_IN(MaterialPoint) at, RL_IN(Instance) inst,
                                    RL_IN(TriangleW) t, RL_IN(vec3) normalW) {
  if ((material.flags & (RL_MATERIAL_UNLIT | RL_MATERIAL_BLACK)) != 0u) return;
  if (RL_HAS(RL_FEATURE_DIFFUSE_TRANSMISSION) &&
      (material.flags & RL_MATERIAL_DIFFUSE_TRANSMISSION) != 0u) {
    float share = closureNumber(at, RL_LAYER_DIFFUSE_TRANSMISSION);
    float diffuse = (1.0f - material.metallic) * (1.0f - material.transmission);
    vec3 passes = closureColor(at, RL_LAYER_DIFFUSE_TRANSMISSION_COLOR) * (share * diffuse);
    s.bsdf.diffuse = material.baseColor * (diffuse * (1.0f - share));
    if (rlIsBlack(s.bsdf.diffuse)) s.bsdf.lobes = s.bsdf.lobes & ~RL_LOBE_DIFFUSE;
    s.bsdf.p3 = vec4(passes.x, passes.y, passes.z, 0.0f);
    if (!rlIsBlack(passes)) s.bsdf.lobes = s.bsdf.lobes | RL_LOBE_DIFFUSE_TRANSMISSION;
  }
  if (RL_HAS(RL_FEATURE_DISPERSION) && (material.flags & RL_MATERIAL_DISPERSION) != 0u &&
      (s.bsdf.lobes & RL_LOBE_ANY_TRANSMISSION) != 0u && (s.bsdf.lobes & RL_LOBE_THIN) == 0u) {
    float spread = 0.025f * closureNumber(at, RL_LAYER_DISPERSION) * (material.ior - 1.0f);
    spread = spread / material.ior;
    // The index over that outside, which is not 1 in another body: no channel is bent the other
    // way.
    float index = s.isFront != 0u ? s.bsdf.eta : 1.0f / s.bsdf.eta;
    spread = min(spread, RL_LARGEST_SPREAD * abs(index - 1.0f) / index);
    s.bsdf.p3.w = s.isFront != 0u ? spread : -spread;
    if (spread > 0.0f) s.bsdf.lobes = s.bsdf.lobes | RL_LOBE_DISPERSION;
  }
  if (RL_HAS(RL_FEATURE_IRIDESCENCE) && (material.flags & RL_MATERIAL_IRIDESCENCE) != 0u)
    surfaceFilm(s, at);
  if (RL_HAS(RL_FEATURE_ANISOTROPY) && (material.flags & RL_MATERIAL_ANISOTROPY) != 0u)
    surfaceStretch(s, at, inst, t, normalW);
  if (RL_HAS(RL_FEATURE_SHEEN) && (material.flags & RL_MATERIAL_SHEEN) != 0u) {
    vec3 color = closureColor(at, RL_LAYER_SHEEN_COLOR);
    float roughness = closureNumber(at, RL_LAYER_SHEEN_ROUGHNESS);
    float alpha = max(roughness * roughness, RL_SHEEN_ALPHA_FLOOR);
    s.bsdf.p1 = vec4(color.x, color.y, color.z, alpha);
    if (!rlIsBlack(color)) s.bsdf.lobes = s.bsdf.lobes | RL_LOBE_SHEEN;
  }
  if (RL_HAS(RL_FEATURE_CLEARCOAT) && (material.flags & RL_MATERIAL_CLEARCOAT) != 0u)
    surfaceCoat(s, material, at, inst, t, normalW);
}
