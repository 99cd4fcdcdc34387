// Weighs the lights of a block, and bounds the instances of the same number. Weights only steer how
// lights are chosen: lamps by power (W), suns by irradiance. An estimate of the scene's box will
// do: light from infinity that misses it is found by the sky's own directions and by the camera's
// paths.

RL_FN float bdptLightWeight(RL_IN(Light) light) {
  float radiance = rlMax3(light.radiance);
  if (light.kind == RL_LIGHT_DIRECTIONAL) return radiance;
  if (light.kind == RL_LIGHT_POINT) return 4.0f * RL_PI * radiance;
  if (light.kind == RL_LIGHT_SPOT) {
    float cosOuter = -light.e2.y / light.e2.x;
    return 2.0f * RL_PI * (1.0f - cosOuter) * radiance;
  }
  float sides = (light.flags & RL_MATERIAL_DOUBLE_SIDED) != 0u ? 2.0f : 1.0f;
  if ((light.flags & RL_LIGHT_SHAPE) != 0u) {
    vec3 h = light.e1;
    return RL_PI * sides * radiance * 8.0f * (h.x * h.y + h.y * h.z + h.z * h.x);
  }
  if (!(light.areaInverse > 0.0f)) return 0.0f;
  vec3 area = cross(light.e1, light.e2);
  return RL_PI * sides * radiance * 0.5f * sqrt(dot(area, area));
}

RL_FN void bdptExtend(RL_INOUT(vec3) low, RL_INOUT(vec3) high, RL_IN(vec3) posW) {
  low = min(low, posW);
  high = max(high, posW);
}

RL_FN void bdptBound(uint instance, RL_INOUT(vec3) low, RL_INOUT(vec3) high) {
  Instance inst = recordInstance(instance);
  Geometry geometry = recordGeometry(inst.geometry);
  if (RL_HAS_SHAPES && shapeIs(geometry)) {
    for (uint i = 0u; i < 8u; i = i + 1u) {
      vec3 corner = vec3((i & 1u) != 0u ? 1.0f : -1.0f, (i & 2u) != 0u ? 1.0f : -1.0f,
                         (i & 4u) != 0u ? 1.0f : -1.0f);
      bdptExtend(low, high, surfaceToWorldPoint(inst, corner));
    }
    return;
  }
  uint most = RL_BDPT_BOX_VERTICES / max(gScene.instanceCount, 1u);
  most = clamp(most, 16u, RL_BDPT_BOX_VERTICES_OF_ONE);
  uint step = (geometry.triangleCount + most - 1u) / most;
  for (uint i = 0u; i < geometry.triangleCount; i = i + max(step, 1u)) {
    uvec3 corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + i);
    TriangleW t = surfaceTriangle(inst, geometry, corners);
    bdptExtend(low, high, t.p0);
    bdptExtend(low, high, t.p0 + t.e1);
    bdptExtend(low, high, t.p0 + t.e2);
  }
}

RL_FN void kernelMain(RL_IN(uvec2) entry) {
  uint block = entry.y * RL_ENTRY_ROW + entry.x;
  if (block >= RL_BDPT_BLOCKS) return;
  float lamps = 0.0f;
  float suns = 0.0f;
  float brightest = 0.0f;
  uint perBlock = (gScene.lightCount + RL_BDPT_BLOCKS - 1u) / RL_BDPT_BLOCKS;
  for (uint i = 0u; i < perBlock; i = i + 1u) {
    uint record = block * perBlock + i;
    if (record >= gScene.lightCount || record == gScene.environmentLight) continue;
    Light light = recordLight(record);
    float weight = bdptLightWeight(light);
    if (light.kind == RL_LIGHT_DIRECTIONAL) {
      suns += weight;
    } else {
      lamps += weight;
    }
    // Lamps without an area count by their power at a distance, in the next pass.
    if (light.kind != RL_LIGHT_POINT && light.kind != RL_LIGHT_SPOT)
      brightest = max(brightest, rlMax3(light.radiance));
  }
  if (environmentExists()) {
    uint texels = gScene.environmentWidth * gScene.environmentHeight;
    uint texel = rlMulHigh(block * (0xffffffffu / RL_BDPT_BLOCKS), texels);
    brightest = max(brightest, rlMax3(RL_SCENE_VEC3(gScene.environment, texel)));
  }
  vec3 low = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  vec3 high = -low;
  for (uint i = block; i < gScene.instanceCount; i = i + RL_BDPT_BLOCKS) bdptBound(i, low, high);
  uint at = block * RL_BDPT_BLOCK_FLOATS;
  gBuffers.blocks.data[at] = lamps;
  gBuffers.blocks.data[at + 1u] = suns;
  gBuffers.blocks.data[at + 2u] = low.x;
  gBuffers.blocks.data[at + 3u] = low.y;
  gBuffers.blocks.data[at + 4u] = low.z;
  gBuffers.blocks.data[at + 5u] = high.x;
  gBuffers.blocks.data[at + 6u] = high.y;
  gBuffers.blocks.data[at + 7u] = high.z;
  gBuffers.blocks.data[at + 8u] = brightest;
}
