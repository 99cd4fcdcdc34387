// Hit -> shading point. The only consumer of materials and of their textures.

RL_FN vec3 surfaceToWorldPoint(RL_IN(Instance) inst, RL_IN(vec3) p) {
  vec4 h = vec4(p, 1.0f);
  return vec3(dot(inst.objectToWorldRow0, h), dot(inst.objectToWorldRow1, h),
              dot(inst.objectToWorldRow2, h));
}

RL_FN vec3 surfaceToWorldVector(RL_IN(Instance) inst, RL_IN(vec3) v) {
  return vec3(dot(vec3(inst.objectToWorldRow0), v), dot(vec3(inst.objectToWorldRow1), v),
              dot(vec3(inst.objectToWorldRow2), v));
}

// Normals transform by the inverse transpose.
RL_FN vec3 surfaceToWorldNormal(RL_IN(Instance) inst, RL_IN(vec3) n) {
  return vec3(inst.worldToObjectRow0) * n.x + vec3(inst.worldToObjectRow1) * n.y +
         vec3(inst.worldToObjectRow2) * n.z;
}

RL_FN TriangleW surfaceTriangle(RL_IN(Instance) inst, RL_IN(Geometry) geometry,
                                RL_IN(uvec3) corners) {
  TriangleW t;
  t.p0 = RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corners.x);
  vec3 p1 = RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corners.y);
  vec3 p2 = RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corners.z);
  t.e1 = p1 - t.p0;
  t.e2 = p2 - t.p0;
  vec3 corner = max(abs(t.p0), max(abs(p1), abs(p2)));
  t.magnitude = rlMax3(corner);
  if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_IDENTITY) == 0u) {
    // |M| |p| + |T| bounds every intermediate of the transform.
    vec4 h = vec4(corner, 1.0f);
    t.magnitude =
        max(dot(abs(inst.objectToWorldRow0), h),
            max(dot(abs(inst.objectToWorldRow1), h), dot(abs(inst.objectToWorldRow2), h)));
    t.p0 = surfaceToWorldPoint(inst, t.p0);
    // Edges are transformed as vectors: differences of far corners would leave small triangles no
    // area.
    t.e1 = surfaceToWorldVector(inst, t.e1);
    t.e2 = surfaceToWorldVector(inst, t.e2);
  }
  return t;
}

RL_PROTO(bool shapeIs(RL_IN(Geometry) geometry))
RL_PROTO(ShapePointW shapePointW(RL_IN(Instance) inst, RL_IN(Geometry) geometry,
                                 RL_IN(SurfaceId) id))

// Index in the light table of a part of an emitting instance: a triangle, or its whole shape.
RL_FN uint surfaceLight(RL_IN(Instance) inst, bool isShape, uint primitive) {
  if (inst.firstLight == RL_INVALID) return RL_INVALID;
  return isShape ? inst.firstLight : inst.firstLight + primitive;
}

// Where the parameters of a material are read; the caller sets firstParameter.
RL_FN MaterialPoint surfaceMaterialPoint(RL_IN(Instance) inst, RL_IN(Geometry) geometry,
                                         uint instance, uint primitive, RL_IN(vec2) bary) {
  MaterialPoint at;
  at.firstParameter = 0u;
  at.geometry = geometry;
  if (RL_HAS_SHAPES && shapeIs(geometry)) {
    SurfaceId id;
    id.instance = instance;
    id.primitive = primitive;
    id.bary = bary;
    ShapePointW shape = shapePointW(inst, geometry, id);
    at.corners = uvec3(0u, 0u, 0u);
    at.bary = shape.uv;
    return at;
  }
  at.corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + primitive);
  at.bary = bary;
  return at;
}

// Coverage of a hit: 1 opaque, 0 a hole.
RL_FN_OUTLINE float surfaceAlpha(RL_IN(Hit) hit) {
  Instance inst = recordInstance(hit.instance);
  Material material = recordMaterial(inst.material);
  if ((material.flags & (RL_MATERIAL_ALPHA_MASK | RL_MATERIAL_ALPHA_BLEND)) == 0u) return 1.0f;
  Geometry geometry = recordGeometry(inst.geometry);
  MaterialPoint at = surfaceMaterialPoint(inst, geometry, hit.instance, hit.primitive, hit.bary);
  uvec3 corners = at.corners;
  float alpha = material.alpha;
  if (RL_HAS(RL_FEATURE_TEXTURES)) {
    vec4 texel = surfaceSlot(material, RL_TEX_BASE_COLOR, geometry, corners, at.bary);
    alpha *= texel.w;
  }
  if (RL_HAS(RL_FEATURE_VERTEX_COLORS) && geometry.colorOffset != RL_INVALID) {
    float a = recordVec4(RL_SCENE_UVEC4(gScene.colors, geometry.colorOffset + corners.x)).w;
    float b = recordVec4(RL_SCENE_UVEC4(gScene.colors, geometry.colorOffset + corners.y)).w;
    float c = recordVec4(RL_SCENE_UVEC4(gScene.colors, geometry.colorOffset + corners.z)).w;
    alpha *= a + hit.bary.x * (b - a) + hit.bary.y * (c - a);
  }
  if ((material.flags & RL_MATERIAL_ALPHA_MASK) != 0u)
    return alpha < material.alphaCutoff ? 0.0f : 1.0f;
  return clamp(alpha, 0.0f, 1.0f);
}

RL_PROTO(void surfaceAddLayers(RL_INOUT(Surface) s, RL_IN(Material) material,
                               RL_IN(MaterialPoint) at, RL_IN(Instance) inst, RL_IN(TriangleW) t,
                               RL_IN(vec3) normalW))

// The tangent of a normal map where the mesh has none: dp/du of the triangle (glTF asks for
// MikkTSpace; the difference is the interpolation of tangents across triangles).
RL_FN vec3 surfaceTangentFromUv(RL_IN(TriangleW) t, RL_IN(Geometry) geometry, RL_IN(uvec3) corners,
                                uint uvSet, RL_OUT(float) handedness) {
  handedness = 1.0f;
  // A shape's bitangent is at the left of u.
  if (RL_HAS_SHAPES && geometry.shape != RL_SHAPE_TRIANGLES) return t.e1;
  uint offset = geometry.uvOffset[uvSet];
  if (offset == RL_INVALID) return vec3(0.0f, 0.0f, 0.0f);
  vec2 uv0 = RL_SCENE_VEC2(gScene.uvs, offset + corners.x);
  vec2 d1 = RL_SCENE_VEC2(gScene.uvs, offset + corners.y) - uv0;
  vec2 d2 = RL_SCENE_VEC2(gScene.uvs, offset + corners.z) - uv0;
  float det = d1.x * d2.y - d2.x * d1.y;
  if (det == 0.0f) return vec3(0.0f, 0.0f, 0.0f);
  handedness = det < 0.0f ? 1.0f : -1.0f;  // glTF's v axis points down
  return (t.e1 * d2.y - t.e2 * d1.y) * (1.0f / det);
}

// The tangent of a mesh at a point, world space, not normalised: its own, or that of a UV set.
RL_FN vec3 surfaceTangent(RL_IN(Instance) inst, RL_IN(Geometry) geometry, RL_IN(uvec3) corners,
                          RL_IN(vec2) bary, RL_IN(TriangleW) t, uint uvSet,
                          RL_OUT(float) handedness) {
  if (geometry.tangentOffset == RL_INVALID)
    return surfaceTangentFromUv(t, geometry, corners, uvSet, handedness);
  vec4 a = recordVec4(RL_SCENE_UVEC4(gScene.tangents, geometry.tangentOffset + corners.x));
  vec4 b = recordVec4(RL_SCENE_UVEC4(gScene.tangents, geometry.tangentOffset + corners.y));
  vec4 c = recordVec4(RL_SCENE_UVEC4(gScene.tangents, geometry.tangentOffset + corners.z));
  vec4 v = a + bary.x * (b - a) + bary.y * (c - a);
  handedness = v.w < 0.0f ? -1.0f : 1.0f;
  vec3 tangentW = vec3(v);
  if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_IDENTITY) == 0u)
    tangentW = surfaceToWorldVector(inst, tangentW);
  return tangentW;
}

// Cosine and sine of the angle from the frame of a normal (core/dialect/frame.glsl) to the tangent.
// Where a mesh has none it runs around the vertical, as the marks of a lathe do.
RL_FN vec2 surfaceTangentAngle(RL_IN(Instance) inst, RL_IN(Geometry) geometry, RL_IN(uvec3) corners,
                               RL_IN(vec2) bary, RL_IN(TriangleW) t, RL_IN(vec3) normalW) {
  float handedness;
  vec3 tangentW = surfaceTangent(inst, geometry, corners, bary, t, 0u, handedness);
  if (rlIsBlack(tangentW)) tangentW = vec3(normalW.z, 0.0f, -normalW.x);
  vec3 local = frameToLocal(normalW, tangentW);
  float length2 = local.x * local.x + local.y * local.y;
  if (!(length2 > 0.0f)) return vec2(1.0f, 0.0f);
  return vec2(local.x, local.y) * (1.0f / sqrt(length2));
}

RL_FN_OUTLINE vec3 surfaceNormalMapped(RL_IN(Instance) inst, RL_IN(Geometry) geometry,
                                       RL_IN(Material) material, RL_IN(uvec3) corners,
                                       RL_IN(vec2) bary, RL_IN(TriangleW) t, RL_IN(vec3) normalW) {
  vec4 texel = surfaceSlot(material, RL_TEX_NORMAL, geometry, corners, bary);
  vec3 local = vec3((texel.x * 2.0f - 1.0f) * material.normalScale,
                    (texel.y * 2.0f - 1.0f) * material.normalScale, texel.z * 2.0f - 1.0f);
  uint uvSet = recordTexture(material.textures[RL_TEX_NORMAL]).uvSet;
  float handedness;
  vec3 tangentW = surfaceTangent(inst, geometry, corners, bary, t, uvSet, handedness);
  // Flip the handedness on a mirrored instance: its image is mirrored, a cross product is not.
  if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_FLIPPED) != 0u)
    handedness = -handedness;
  tangentW = tangentW - normalW * dot(normalW, tangentW);
  float len2 = dot(tangentW, tangentW);
  if (!(len2 > 0.0f)) return normalW;  // no usable parametrisation: the unperturbed normal
  tangentW = tangentW * (1.0f / sqrt(len2));
  vec3 bitangentW = cross(normalW, tangentW) * handedness;
  vec3 n = tangentW * local.x + bitangentW * local.y + normalW * local.z;
  float n2 = dot(n, n);
  return n2 > 0.0f ? n * (1.0f / sqrt(n2)) : normalW;
}

// Keeps a hit off the triangle's edges by the error bound (for a sliver by a thousandth). A hit
// within rounding of an edge may lie beyond the neighbouring face, and rays from it would leak out
// of a closed mesh. area2 is the squared length of cross(e1, e2).
RL_FN vec2 surfaceInnerBary(RL_IN(TriangleW) t, float area2, float posError, RL_IN(vec2) bary) {
  vec3 e3 = t.e2 - t.e1;
  float longest2 = max(dot(t.e1, t.e1), max(dot(t.e2, t.e2), dot(e3, e3)));
  float least = min(posError * sqrt(longest2 / area2), 1.0e-3f);
  float b0 = 1.0f - bary.x - bary.y;
  if (!(min(b0, min(bary.x, bary.y)) < least)) return bary;
  vec2 inner = max(bary, vec2(least, least));
  return inner * (1.0f / (max(b0, least) + inner.x + inner.y));
}

RL_FN Surface surfaceNone() {
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  Surface s;
  s.id = surfaceIdNone();
  s.isFront = 1u;
  s.posW = zero;
  s.posError = 0.0f;
  s.nGeoW = vec3(0.0f, 0.0f, 1.0f);
  s.nShadeW = s.nGeoW;
  s.wo = s.nGeoW;
  s.emission = zero;
  s.sigmaBeyond = zero;
  s.contrast = 0.0f;
  s.light = RL_INVALID;
  s.bsdf = bsdfNone();
  return s;
}

// Point of a triangle with corner, edges and error bound. A triangle so small that its cross
// product underflows has the normal `fallback`: traversal must never see NaN.
RL_FN SurfacePoint surfacePointOf(RL_IN(TriangleW) t, RL_IN(Instance) inst, RL_IN(vec2) bary,
                                  RL_IN(vec3) fallback) {
  SurfacePoint p;
  p.posError = RL_HIT_ERROR * t.magnitude;
  vec3 area = cross(t.e1, t.e2);
  float area2 = dot(area, area);
  p.normalW = area2 > 0.0f ? area * (1.0f / sqrt(area2)) : fallback;
  vec2 inner = surfaceInnerBary(t, area2, p.posError, bary);
  p.posW = t.p0 + inner.x * t.e1 + inner.y * t.e2;
  if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_FLIPPED) != 0u)
    p.normalW = -p.normalW;
  return p;
}

RL_FN SurfacePoint surfacePointOfShape(RL_IN(ShapePointW) shape) {
  SurfacePoint p;
  p.posError = RL_HIT_ERROR * shape.tangents.magnitude;
  p.posW = shape.tangents.p0;
  p.normalW = shape.normalW;
  return p;
}

// The point that an id names.
RL_FN SurfacePoint surfacePointAt(RL_IN(SurfaceId) id) {
  Instance inst = recordInstance(id.instance);
  Geometry geometry = recordGeometry(inst.geometry);
  if (RL_HAS_SHAPES && shapeIs(geometry))
    return surfacePointOfShape(shapePointW(inst, geometry, id));
  uvec3 corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + id.primitive);
  return surfacePointOf(surfaceTriangle(inst, geometry, corners), inst, id.bary,
                        vec3(0.0f, 0.0f, 1.0f));
}

// contrast: index of refraction inside over that outside, where the outside is not air; 0: the
// material's own.
RL_FN Surface surfaceLoadBetween(RL_IN(Hit) hit, RL_IN(vec3) rayDir, float contrast) {
  Surface s;
  Instance inst = recordInstance(hit.instance);
  Geometry geometry = recordGeometry(inst.geometry);
  Material material = recordMaterial(inst.material);
  s.id.instance = hit.instance;
  s.id.primitive = hit.primitive;
  s.id.bary = hit.bary;
  s.wo = -rayDir;
  s.contrast = contrast;
  bool isShape = RL_HAS_SHAPES && shapeIs(geometry);
  uvec3 corners;
  TriangleW t;
  SurfacePoint point;
  vec2 bary = hit.bary;
  if (isShape) {
    ShapePointW shape = shapePointW(inst, geometry, s.id);
    corners = uvec3(0u, 0u, 0u);
    t = shape.tangents;
    point = surfacePointOfShape(shape);
    bary = shape.uv;
  } else {
    corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + hit.primitive);
    t = surfaceTriangle(inst, geometry, corners);
    point = surfacePointOf(t, inst, bary, s.wo);
  }
  s.posError = point.posError;
  s.posW = point.posW;
  vec3 nGeo = point.normalW;
  bool isFront = dot(nGeo, s.wo) > 0.0f;
  vec3 nShade = nGeo;
  if (RL_HAS(RL_FEATURE_SMOOTH_NORMALS) && geometry.normalOffset != RL_INVALID) {
    vec3 a = RL_SCENE_VEC3(gScene.normals, geometry.normalOffset + corners.x);
    vec3 b = RL_SCENE_VEC3(gScene.normals, geometry.normalOffset + corners.y);
    vec3 c = RL_SCENE_VEC3(gScene.normals, geometry.normalOffset + corners.z);
    vec3 n = a + bary.x * (b - a) + bary.y * (c - a);
    if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_IDENTITY) == 0u) {
      n = surfaceToWorldNormal(inst, n);
    }
    float len2 = dot(n, n);
    if (len2 > 0.0f) nShade = n * (1.0f / sqrt(len2));
  }
  vec3 nVertex = nShade;
  if (RL_HAS(RL_FEATURE_NORMAL_MAPS) && material.textures[RL_TEX_NORMAL] != RL_INVALID) {
    nShade = surfaceNormalMapped(inst, geometry, material, corners, bary, t, nShade);
  }
  s.isFront = isFront ? 1u : 0u;
  s.nGeoW = isFront ? nGeo : -nGeo;
  // Mirror back a shading normal on the far side of the face: it has no meaning as a reflector.
  if (!isFront) nShade = -nShade;
  float side = dot(nShade, s.nGeoW);
  if (side <= 0.0f) nShade = normalize(nShade - s.nGeoW * (2.0f * side) + s.nGeoW * 1.0e-3f);
  s.nShadeW = nShade;

  MaterialPoint at;
  at.firstParameter = material.firstParameter;
  at.geometry = geometry;
  at.corners = corners;
  at.bary = bary;
  materialTexture(material, at);

  s.light = surfaceLight(inst, isShape, hit.primitive);
  bool emits = isFront || (material.flags & RL_MATERIAL_DOUBLE_SIDED) != 0u;
  s.emission = emits ? material.emission : vec3(0.0f, 0.0f, 0.0f);
  if ((material.flags & RL_MATERIAL_UNLIT) != 0u) s.emission = material.baseColor;
  s.sigmaBeyond = vec3(0.0f, 0.0f, 0.0f);

  if (RL_HAS_CLOSURES && material.closure != RL_CLOSURE_GLTF) {
    s.bsdf = bsdfNone();
    if ((material.flags & (RL_MATERIAL_UNLIT | RL_MATERIAL_BLACK)) != 0u) return s;
    s.bsdf.closure = material.closure;
    if ((material.flags & RL_MATERIAL_ANISOTROPIC) != 0u)
      s.bsdf.tangent = surfaceTangentAngle(inst, geometry, corners, bary, t, s.nShadeW);
    if (RL_HAS_CLOSURE(RL_CLOSURE_MIXTURE) && mixtureIs(s.bsdf)) {
      mixtureLoad(s.bsdf, at, hit.instance, hit.primitive);
      return s;
    }
    closureLoad(s.bsdf, at);
    return s;
  }
  s.bsdf = materialLobes(material, isFront, contrast);
  if (RL_HAS(RL_FEATURE_LAYERS) && (material.flags & RL_MATERIAL_LAYERS) != 0u)
    surfaceAddLayers(s, material, at, inst, t, nVertex);
  return s;
}

RL_FN Surface surfaceLoad(RL_IN(Hit) hit, RL_IN(vec3) rayDir) {
  return surfaceLoadBetween(hit, rayDir, 0.0f);
}

// The surface that an id names, as seen from the direction wo (unit), in air.
RL_FN Surface surfaceAt(RL_IN(SurfaceId) id, RL_IN(vec3) wo) {
  Hit hit;
  hit.instance = id.instance;
  hit.primitive = id.primitive;
  hit.bary = id.bary;
  hit.t = 0.0f;
  return surfaceLoadBetween(hit, -wo, 0.0f);
}

// Absorption (m^-1) along a ray that leaves a surface towards dirW: that of the medium through
// which the surface was reached, or, on the other side, of the medium beyond.
RL_FN vec3 surfaceSigma(RL_IN(Surface) s, RL_IN(vec3) sigmaReached, RL_IN(vec3) dirW) {
  return dot(s.nGeoW, dirW) >= 0.0f ? sigmaReached : s.sigmaBeyond;
}

// Origin of a ray that leaves a surface towards dirW: moved off the plane by the error bound, to
// the side it goes to.
RL_FN vec3 surfaceOffset(RL_IN(vec3) posW, RL_IN(vec3) nGeoW, float posError, RL_IN(vec3) dirW) {
  return dot(nGeoW, dirW) >= 0.0f ? posW + nGeoW * posError : posW - nGeoW * posError;
}

// End of a segment at a surface point; dirW points to the segment's origin, whose position has the
// error originError. Traversal rounds the distance relative to the segment's length, which the
// larger of both errors covers: each grows with the distance from the scene's origin.
RL_FN vec3 surfaceSegmentEnd(RL_IN(vec3) posW, RL_IN(vec3) nGeoW, float posError, float originError,
                             RL_IN(vec3) dirW) {
  return surfaceOffset(posW, nGeoW, max(posError, originError), dirW);
}

// Radiance that a surface sends on of the light that comes from everywhere (SceneData::ambient).
RL_FN vec3 surfaceAmbient(RL_IN(Surface) s) {
  return gScene.ambient * min(bsdfAlbedo(s.bsdf), vec3(1.0f, 1.0f, 1.0f));
}
