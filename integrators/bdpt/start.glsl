// How light begins: choice of a light and of a point on it, and directions from there. Lights are
// chosen by the table of bdpt.h, areas uniformly, directions from them by the cosine. Nothing of
// core/shading/light.glsl is used but the maps themselves; a sky is drawn by its texels, and one
// time in four uniformly.

RL_FN float bdptWord(uint i) { return uintBitsToFloat(gBuffers.table.data[i]); }
RL_FN vec3 bdptCentre() { return vec3(bdptWord(0u), bdptWord(1u), bdptWord(2u)); }
RL_FN float bdptRadius() { return bdptWord(3u); }

// Density per area of a light at infinity across its direction, of rays through the scene's ball.
RL_FN float bdptDensityAcross() {
  float radius = bdptRadius();
  return rlSafeDivide(1.0f, RL_PI * radius * radius);
}

// The same at a point: 0 outside of the ball's shadow, and between the ball and the light, where no
// ray begins.
RL_FN float bdptDensityAcrossAt(RL_IN(vec3) posW, RL_IN(vec3) toSky) {
  vec3 d = posW - bdptCentre();
  float along = dot(d, toSky);
  float radius = bdptRadius();
  bool isBehind = along < radius;
  bool isInShadow = dot(d, d) - along * along < radius * radius;
  return isBehind && isInShadow ? bdptDensityAcross() : 0.0f;
}

RL_FN uint bdptRecordsOfBlock(uint block) {
  uint perBlock = gBuffers.table.data[RL_BDPT_TABLE_PER_BLOCK];
  return min(perBlock, gScene.lightCount - min(block * perBlock, gScene.lightCount));
}

// Probability that a light is chosen.
RL_FN float bdptLightShare(uint record) {
  float sky = bdptWord(RL_BDPT_TABLE_SKY);
  uint block = record / max(gBuffers.table.data[RL_BDPT_TABLE_PER_BLOCK], 1u);
  uint high = gBuffers.table.data[RL_BDPT_TABLE_BOUNDS + block];
  uint low = block > 0u ? gBuffers.table.data[RL_BDPT_TABLE_BOUNDS + block - 1u] : 0u;
  float share = float(high - low) * 2.3283064365386963e-10f;
  float ofBlock = (1.0f - sky) * share / float(max(bdptRecordsOfBlock(block), 1u));
  // The sky may share a block with lamps, and then is chosen in both ways.
  return record == gScene.environmentLight ? sky + ofBlock : ofBlock;
}

// Chooses a light; RL_INVALID: none shines.
RL_FN uint bdptChooseLight(RL_IN(Rng) rng) {
  uint skyBits = rngBits(rng, RL_DIM_RIS_LIGHT);
  // The bound of the last blocks is the greatest number.
  uint drawn = rngBits(rng, RL_DIM_LIGHT_SELECT);
  uint blockBits = min(drawn, 0xfffffffeu);
  uint recordBits = rngBits(rng, RL_DIM_LIGHT_ALIAS);
  if (rngUnit(skyBits) < bdptWord(RL_BDPT_TABLE_SKY)) return gScene.environmentLight;
  if (gBuffers.table.data[RL_BDPT_TABLE_BOUNDS + RL_BDPT_BLOCKS - 1u] == 0u) return RL_INVALID;
  // The first block whose bound is above the bits.
  uint low = 0u;
  uint count = RL_BDPT_BLOCKS - 1u;
  while (count > 0u) {
    uint step = count / 2u;
    if (gBuffers.table.data[RL_BDPT_TABLE_BOUNDS + low + step] <= blockBits) {
      low = low + step + 1u;
      count = count - step - 1u;
    } else {
      count = step;
    }
  }
  uint perBlock = gBuffers.table.data[RL_BDPT_TABLE_PER_BLOCK];
  return low * perBlock + rlMulHigh(recordBits, bdptRecordsOfBlock(low));
}

RL_FN bool bdptIsShapeLight(RL_IN(Light) light) {
  return RL_HAS_SHAPES && (light.flags & RL_LIGHT_SHAPE) != 0u;
}

// Density per area of a point of a shape that is drawn for its own centre.
RL_FN float bdptShapeDensity(RL_IN(Instance) inst, RL_IN(Geometry) geometry, RL_IN(SurfaceId) id) {
  Shape shape = shapeOf(geometry);
  ShapePoint p = shapePoint(shape, id);
  float density = shapeDensity(shape, vec3(0.0f, 0.0f, 0.0f), p);
  return rlSafeDivide(density, shapePointToWorld(inst, p).areaFactor);
}

// Density per area with which a point of a surface that emits is drawn, choice of the light
// included.
RL_FN float bdptLightDensity(uint record, RL_IN(SurfaceId) id) {
  Light light = recordLight(record);
  float share = bdptLightShare(record);
  if (bdptIsShapeLight(light)) {
    Instance inst = recordInstance(id.instance);
    return share * bdptShapeDensity(inst, recordGeometry(inst.geometry), id);
  }
  vec3 area = cross(light.e1, light.e2);
  return share * rlSafeDivide(2.0f, sqrt(dot(area, area)));
}

// Density per solid angle with which a direction to the sky is drawn, choice of the light included.
RL_FN float bdptSkyDensity(RL_IN(vec3) dirW) {
  if (gScene.environmentLight == RL_INVALID) return 0.0f;
  float density = 0.75f * environmentPdf(dirW) + 0.0625f * RL_INV_PI;
  return bdptLightShare(gScene.environmentLight) * density;
}

RL_FN vec3 bdptUniformDirection(RL_IN(vec2) u, float cosLeast) {
  float below = u.x * (1.0f - cosLeast);
  float sine = sqrt(max(0.0f, below * (2.0f - below)));
  vec2 cs = rlCosSin2Pi(u.y);
  return vec3(sine * cs.x, sine * cs.y, 1.0f - below);
}

RL_FN BdptStart bdptStartAt(uint record) {
  BdptStart start;
  start.kind = RL_LIGHT_POINT;
  start.record = record;
  start.point = vec3(0.0f, 0.0f, 0.0f);
  start.posError = 0.0f;
  start.normal = vec3(0.0f, 0.0f, 1.0f);
  start.isTwoSided = 0u;
  start.cone = vec2(0.0f, 0.0f);
  start.emitted = vec3(0.0f, 0.0f, 0.0f);
  start.pdf = 0.0f;
  start.isFindable = 0u;
  return start;
}

// Draws a light and a point on it. pdf 0: none.
RL_FN BdptStart bdptStart(RL_IN(Rng) rng) {
  BdptStart start = bdptStartAt(bdptChooseLight(rng));
  if (start.record == RL_INVALID) return start;
  lightTellDrawn(start.record);
  Light light = recordLight(start.record);
  start.kind = light.kind;
  start.pdf = bdptLightShare(start.record);
  start.emitted = light.radiance;
  uint uBits = rngBits(rng, RL_DIM_LIGHT_U);
  uint vBits = rngBits(rng, RL_DIM_LIGHT_V);
  vec2 u = vec2(rngUnit(uBits), rngUnit(vBits));
  if (RL_HAS(RL_FEATURE_AREA_LIGHTS) && light.kind == RL_LIGHT_AREA) {
    SurfaceId id;
    id.instance = light.instance;
    id.primitive = light.primitive;
    id.bary = warpTriangle(u);
    Instance inst = recordInstance(light.instance);
    if (bdptIsShapeLight(light)) {
      Geometry geometry = recordGeometry(inst.geometry);
      id = shapeDraw(shapeOf(geometry), vec3(0.0f, 0.0f, 0.0f), u);
      id.instance = light.instance;
    }
    SurfacePoint p = surfacePointAt(id);
    start.point = p.posW;
    start.posError = p.posError;
    start.normal = p.normalW;
    start.isTwoSided = light.flags & RL_MATERIAL_DOUBLE_SIDED;
    start.pdf = bdptLightDensity(start.record, id);
    start.isFindable = 1u;
    if (RL_HAS(RL_FEATURE_EMISSIVE_TEXTURES)) start.emitted *= lightTexture(id);
    if (RL_HAS(RL_FEATURE_ALPHA)) {
      Hit hit = traceNoHit();
      hit.instance = id.instance;
      hit.primitive = id.primitive;
      hit.bary = id.bary;
      start.emitted *= surfaceAlpha(hit);
    }
  }
  if (RL_HAS(RL_FEATURE_PUNCTUAL_LIGHTS)) {
    if (light.kind == RL_LIGHT_POINT || light.kind == RL_LIGHT_SPOT) start.point = light.p0;
    if (light.kind == RL_LIGHT_POINT) start.normal = light.e2;
    if (light.kind == RL_LIGHT_SPOT) {
      start.normal = light.e1;
      start.cone = vec2(light.e2.x, light.e2.y);
    }
    if (light.kind == RL_LIGHT_DIRECTIONAL) start.point = -light.e1;
  }
  if (RL_HAS(RL_FEATURE_ENVIRONMENT) && light.kind == RL_LIGHT_ENVIRONMENT) {
    uint aliasBits = rngBits(rng, RL_DIM_ENVIRONMENT_ALIAS);
    float density;
    start.point = environmentDraw(uvec2(uBits, vBits), aliasBits, density);
    if (rngDraw(rng, RL_DIM_RIS_DIRECT) < 0.25f) start.point = bdptUniformDirection(u, -1.0f);
    start.emitted = environmentRadiance(start.point);
    start.pdf = bdptSkyDensity(start.point);
    start.isFindable = 1u;
  }
  return start;
}

RL_FN bool bdptIsFar(RL_IN(BdptStart) start) {
  return start.kind == RL_LIGHT_ENVIRONMENT || start.kind == RL_LIGHT_DIRECTIONAL;
}

// Light that is sent in a direction (unit, away from the light) over a distance: radiance, or of a
// light without an area what arrives across the direction.
RL_FN vec3 bdptEmitted(RL_IN(BdptStart) start, RL_IN(vec3) dirW, float distance) {
  if (start.kind == RL_LIGHT_AREA) {
    bool emits = start.isTwoSided != 0u || dot(start.normal, dirW) > 0.0f;
    return emits ? start.emitted : vec3(0.0f, 0.0f, 0.0f);
  }
  if (bdptIsFar(start)) return start.emitted;
  float fall = distance * distance;
  if (start.kind == RL_LIGHT_POINT)
    fall = start.normal.x + start.normal.y * distance + start.normal.z * fall;
  vec3 emitted = start.emitted * rlSafeDivide(1.0f, fall);
  if (start.kind == RL_LIGHT_SPOT) {
    float falloff = clamp(dot(dirW, start.normal) * start.cone.x + start.cone.y, 0.0f, 1.0f);
    emitted = emitted * (falloff * falloff);
  }
  return emitted;
}

// Cosine of the edge of a spot light's cone.
RL_FN float bdptConeEdge(RL_IN(BdptStart) start) { return -start.cone.y / start.cone.x; }

// Density of directions from a light: per solid angle, or per area across one at infinity. posW: a
// point that the direction leads to.
RL_FN float bdptDirectionDensity(RL_IN(BdptStart) start, RL_IN(vec3) dirW, RL_IN(vec3) posW) {
  if (bdptIsFar(start)) return bdptDensityAcrossAt(posW, -dirW);
  if (start.kind == RL_LIGHT_POINT) return 0.25f * RL_INV_PI;
  float cosine = dot(start.normal, dirW);
  if (start.kind == RL_LIGHT_SPOT) {
    float edge = bdptConeEdge(start);
    return cosine > edge ? 0.5f * RL_INV_PI / (1.0f - edge) : 0.0f;
  }
  if (start.isTwoSided != 0u) return 0.5f * RL_INV_PI * abs(cosine);
  return RL_INV_PI * max(cosine, 0.0f);
}

// Draws a ray from a light. Sets throughput, densities and the ray of the path; a point light's
// throughput lacks the factor of its distance.
RL_FN void bdptEmit(RL_IN(BdptStart) start, RL_IN(Rng) rng, RL_INOUT(BdptPath) path) {
  vec2 u;
  u.x = rngDraw(rng, RL_DIM_BSDF_U);
  u.y = rngDraw(rng, RL_DIM_BSDF_V);
  float uSide = rngDraw(rng, RL_DIM_BSDF_LOBE);
  path.isParallel = 0u;
  path.pastDensity = start.pdf;
  path.pastOthers = start.isFindable != 0u ? 1.0f : 0.0f;
  path.pastJoins = 1.0f;
  path.pastCosine = 1.0f;
  path.ray.tMin = 0.0f;
  path.ray.tMax = 3.0e38f;
  path.ray.origin = start.point;
  path.isAlive = start.pdf > 0.0f && !rlIsBlack(start.emitted) ? 1u : 0u;
  float scale = rlSafeDivide(1.0f, start.pdf);
  if (start.kind == RL_LIGHT_AREA) {
    vec3 dirL = warpCosineHemisphere(u);
    vec3 side = start.normal;
    if (start.isTwoSided != 0u && uSide < 0.5f) side = -side;
    path.ray.dir = frameToWorld(side, dirL);
    path.pastCosine = abs(dot(start.normal, path.ray.dir));
    path.ray.origin = surfaceOffset(start.point, start.normal, start.posError, path.ray.dir);
    path.pdfRay = bdptDirectionDensity(start, path.ray.dir, start.point);
    if (!(path.pdfRay > 0.0f)) path.isAlive = 0u;
    path.throughput = start.emitted * (scale * rlSafeDivide(path.pastCosine, path.pdfRay));
    return;
  }
  if (bdptIsFar(start)) {
    path.isParallel = 1u;
    path.pdfRay = bdptDensityAcross();
    float radius = bdptRadius();
    vec2 disk = rlCosSin2Pi(u.y) * sqrt(u.x);
    vec3 tangent;
    vec3 bitangent;
    frameFromNormal(start.point, tangent, bitangent);
    path.ray.dir = -start.point;
    path.ray.origin = bdptCentre() + (tangent * disk.x + bitangent * disk.y + start.point) * radius;
    if (!(path.pdfRay > 0.0f)) path.isAlive = 0u;
    path.throughput = start.emitted * (scale * rlSafeDivide(1.0f, path.pdfRay));
    return;
  }
  if (start.kind == RL_LIGHT_SPOT) {
    float edge = bdptConeEdge(start);
    path.ray.dir = frameToWorld(start.normal, bdptUniformDirection(u, edge));
    path.pdfRay = 0.5f * RL_INV_PI / (1.0f - edge);
    float falloff =
        clamp(dot(path.ray.dir, start.normal) * start.cone.x + start.cone.y, 0.0f, 1.0f);
    scale *= falloff * falloff;
    if (!(falloff > 0.0f)) path.isAlive = 0u;
  } else {
    path.ray.dir = bdptUniformDirection(u, -1.0f);
    path.pdfRay = 0.25f * RL_INV_PI;
  }
  path.throughput = start.emitted * (scale / path.pdfRay);
}
