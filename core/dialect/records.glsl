// Scene records, read as uvec4s. On devices that walk the lanes of a vector one by one, one
// access of four words costs a quarter of four accesses.

RL_FN vec3 recordVec3(RL_IN(uvec4) q) {
  return vec3(uintBitsToFloat(q.x), uintBitsToFloat(q.y), uintBitsToFloat(q.z));
}

RL_FN vec4 recordVec4(RL_IN(uvec4) q) {
  return vec4(uintBitsToFloat(q.x), uintBitsToFloat(q.y), uintBitsToFloat(q.z),
              uintBitsToFloat(q.w));
}

RL_FN uvec4 recordUvec4(RL_IN(vec3) v, uint w) {
  return uvec4(floatBitsToUint(v.x), floatBitsToUint(v.y), floatBitsToUint(v.z), w);
}

RL_FN Geometry recordGeometry(uint index) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.geometries, index * 3u);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.geometries, index * 3u + 1u);
  uvec4 q2 = RL_SCENE_UVEC4(gScene.geometries, index * 3u + 2u);
  Geometry g;
  g.firstTriangle = q0.x;
  g.triangleCount = q0.y;
  g.firstVertex = q0.z;
  g.normalOffset = q0.w;
  g.tangentOffset = q1.x;
  g.colorOffset = q1.y;
  g.uvOffset[0] = q1.z;
  g.uvOffset[1] = q1.w;
  g.uvOffset[2] = q2.x;
  g.uvOffset[3] = q2.y;
  g.shape = q2.z;
  g.firstShapeWord = q2.w;
  return g;
}

RL_FN Instance recordInstance(uint index) {
  Instance inst;
  inst.objectToWorldRow0 = recordVec4(RL_SCENE_UVEC4(gScene.instances, index * 7u));
  inst.objectToWorldRow1 = recordVec4(RL_SCENE_UVEC4(gScene.instances, index * 7u + 1u));
  inst.objectToWorldRow2 = recordVec4(RL_SCENE_UVEC4(gScene.instances, index * 7u + 2u));
  inst.worldToObjectRow0 = recordVec4(RL_SCENE_UVEC4(gScene.instances, index * 7u + 3u));
  inst.worldToObjectRow1 = recordVec4(RL_SCENE_UVEC4(gScene.instances, index * 7u + 4u));
  inst.worldToObjectRow2 = recordVec4(RL_SCENE_UVEC4(gScene.instances, index * 7u + 5u));
  uvec4 q = RL_SCENE_UVEC4(gScene.instances, index * 7u + 6u);
  inst.geometry = q.x;
  inst.material = q.y;
  inst.firstLight = q.z;
  inst.flags = q.w;
  return inst;
}

RL_FN Material recordMaterial(uint index) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.materials, index * 8u);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 1u);
  uvec4 q2 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 2u);
  uvec4 q3 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 3u);
  uvec4 q4 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 4u);
  uvec4 q5 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 5u);
  uvec4 q6 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 6u);
  Material m;
  m.baseColor = recordVec3(q0);
  m.alpha = uintBitsToFloat(q0.w);
  m.emission = recordVec3(q1);
  m.alphaCutoff = uintBitsToFloat(q1.w);
  m.metallic = uintBitsToFloat(q2.x);
  m.roughness = uintBitsToFloat(q2.y);
  m.ior = uintBitsToFloat(q2.z);
  m.transmission = uintBitsToFloat(q2.w);
  m.specularColor = recordVec3(q3);
  m.specular = uintBitsToFloat(q3.w);
  m.sigmaAbsorption = recordVec3(q4);
  m.normalScale = uintBitsToFloat(q4.w);
  m.flags = q5.x;
  m.textures[0] = q5.y;
  m.textures[1] = q5.z;
  m.textures[2] = q5.w;
  m.textures[3] = q6.x;
  m.textures[4] = q6.y;
  m.textures[5] = q6.z;
  m.textures[6] = q6.w;
  if (RL_HAS_CLOSURES || RL_HAS(RL_FEATURE_LAYERS)) {
    uvec4 q7 = RL_SCENE_UVEC4(gScene.materials, index * 8u + 7u);
    m.closure = q7.x;
    m.firstParameter = q7.y;
  }
  return m;
}

RL_FN Texture recordTexture(uint index) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.textures, index * 4u);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.textures, index * 4u + 1u);
  uvec4 q2 = RL_SCENE_UVEC4(gScene.textures, index * 4u + 2u);
  uvec4 q3 = RL_SCENE_UVEC4(gScene.textures, index * 4u + 3u);
  Texture t;
  t.uvRow0 = recordVec3(q0);
  t.uvRow1 = vec3(uintBitsToFloat(q0.w), uintBitsToFloat(q1.x), uintBitsToFloat(q1.y));
  t.firstTexel = q1.z;
  t.width = q1.w;
  t.height = q2.x;
  t.wrapU = q2.y;
  t.wrapV = q2.z;
  t.flags = q2.w;
  t.uvSet = q3.x;
  return t;
}

RL_FN Light recordLight(uint index) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.lights, index * 5u);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.lights, index * 5u + 1u);
  uvec4 q2 = RL_SCENE_UVEC4(gScene.lights, index * 5u + 2u);
  uvec4 q3 = RL_SCENE_UVEC4(gScene.lights, index * 5u + 3u);
  uvec4 q4 = RL_SCENE_UVEC4(gScene.lights, index * 5u + 4u);
  Light light;
  light.p0 = recordVec3(q0);
  light.kind = q0.w;
  light.e1 = recordVec3(q1);
  light.pmf = uintBitsToFloat(q1.w);
  light.e2 = recordVec3(q2);
  light.areaInverse = uintBitsToFloat(q2.w);
  light.radiance = recordVec3(q3);
  light.instance = q3.w;
  light.primitive = q4.x;
  light.flags = q4.y;
  light.magnitude = uintBitsToFloat(q4.z);
  light.padding = q4.w;
  return light;
}

RL_FN AliasEntry recordAlias(RL_IN(uvec3) words) {
  AliasEntry entry;
  entry.keep = words.x;
  entry.other = words.y;
  entry.pmf = uintBitsToFloat(words.z);
  return entry;
}
