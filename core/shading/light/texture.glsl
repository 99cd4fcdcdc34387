// The emissive texture at a point of a surface that emits.

RL_FN_OUTLINE vec3 lightTexture(RL_IN(SurfaceId) id) {
  Instance inst = recordInstance(id.instance);
  Geometry geometry = recordGeometry(inst.geometry);
  Material material = recordMaterial(inst.material);
  if (material.textures[RL_TEX_EMISSIVE] == RL_INVALID) return vec3(1.0f, 1.0f, 1.0f);
  MaterialPoint at = surfaceMaterialPoint(inst, geometry, id.instance, id.primitive, id.bary);
  return vec3(surfaceSlot(material, RL_TEX_EMISSIVE, geometry, at.corners, at.bary));
}
