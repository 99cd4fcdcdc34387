// The emissive texture at a point of an emissive triangle.

RL_FN_OUTLINE vec3 lightTexture(RL_IN(Light) light, RL_IN(vec2) bary) {
  Instance inst = recordInstance(light.instance);
  Geometry geometry = recordGeometry(inst.geometry);
  Material material = recordMaterial(inst.material);
  if (material.textures[RL_TEX_EMISSIVE] == RL_INVALID) return vec3(1.0f, 1.0f, 1.0f);
  uvec3 corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + light.primitive);
  return vec3(surfaceSlot(material, RL_TEX_EMISSIVE, geometry, corners, bary));
}
